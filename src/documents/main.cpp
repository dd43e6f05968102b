// Writes the man pages and completions of all programs; run by the build, not installed.
//   asdfvk-write-documents FOLDER
// The files have the paths in FOLDER that they have below share: man/man1/asdf-vk.1 and so on.
#include <cstdio>
#include <exception>
#include <filesystem>

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
  if (argc != 2) return 1;
  const std::filesystem::path folder = argv[1];
  try {
    writeText(folder / "man/man1/asdf-vk-summarize.1", manPage(asdfvk::documentedSummarize()));
    for (const asdfvk::Program& program : asdfvk::documentedPrograms()) {
      const std::string& name = program.name;
      writeText(folder / "man/man1" / (name + ".1"), manPage(program));
      writeText(folder / "bash-completion/completions" / name, bashCompletion(program));
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "asdfvk-write-documents: %s\n", error.what());
    return 1;
  }
}
