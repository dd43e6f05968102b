// asdfvk-write-documents SOURCES          writes docs/options.md, which a test compares
// asdfvk-write-documents SOURCES FOLDER   writes the man pages into FOLDER; run by the build, not installed
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "asdf_vk/version.h"
#include "cli/exit_code.h"
#include "cli/options.h"
#include "core/atomic_file.h"
#include "documents/documents.h"
#include "generate/generator_options.h"

namespace {

using namespace asdfvk;

std::string textOf(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

void writeText(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void writePages(const std::filesystem::path& sources, const std::filesystem::path& folder) {
  std::vector<std::pair<int, std::string>> codes;
  for (const auto& [code, meaning] : kExitCodes) codes.emplace_back(static_cast<int>(code), meaning);
  codes.back().second += std::string(". ") + kExitCodeOfSeveralMeshes;
  CommandLine line;
  GeneratorOptions generator;
  const auto write = [&](const char* name, const std::string& help, const auto& exitCodes) {
    writeText(folder / name, manPage(textOf(sources / "docs/man" / name), ASDFVK_VERSION, help, exitCodes));
  };
  std::filesystem::create_directories(folder);
  write("asdf-vk.1", parserOf(line).help(), codes);
  write("asdf-vk-generate.1", parserOf(generator).help(),
        std::vector<std::pair<int, std::string>>(kGeneratorExitCodes.begin(), kGeneratorExitCodes.end()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) return 1;
  try {
    const std::filesystem::path sources = argv[1], options = sources / "docs/options.md";
    if (argc == 2)
      writeText(options, optionPage(textOf(options)));
    else
      writePages(sources, argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "asdfvk-write-documents: %s\n", error.what());
    return 1;
  }
}
