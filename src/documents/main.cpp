// Writes the man pages and completions of all programs; run by the build, not installed.
//   asdfvk-write-documents FOLDER [SOURCES]
// The files have the paths in FOLDER that they have below share: man/man1/asdf-vk.1 and so on. With the folder of the
// sources also docs/options.md and python/asdf_vk/_keywords.py, which a test compares.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/atomic_file.h"
#include "documents/program.h"

namespace {

void writeText(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  asdfvk::AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) return 1;
  const std::filesystem::path folder = argv[1];
  try {
    writeText(folder / "man/man1/asdf-vk-summarize.1", manPage(asdfvk::documentedSummarize()));
    for (const asdfvk::Program& program : asdfvk::documentedPrograms()) {
      const std::string& name = program.name;
      writeText(folder / "man/man1" / (name + ".1"), manPage(program));
      writeText(folder / "bash-completion/completions" / name, bashCompletion(program));
    }
    if (argc == 3) {
      const std::filesystem::path sources = argv[2], options = sources / "docs/options.md";
      std::ifstream in(options);
      const std::string page{std::istreambuf_iterator<char>(in), {}};
      writeText(options, asdfvk::optionPage(page));
      writeText(sources / "python/asdf_vk/_keywords.py", asdfvk::keywordModule());
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "asdfvk-write-documents: %s\n", error.what());
    return 1;
  }
}
