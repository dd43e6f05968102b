// asdfvk-write-documents SOURCES          writes docs/options.md, docs/formats.md, docs/schema.json, and
//                                         python/asdf_vk/_keywords.py and _report.py; a test compares these files
// asdfvk-write-documents SOURCES FOLDER   writes the man pages into FOLDER; run by the build, not installed
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "asdf_vk/version.h"
#include "cli/command_line.h"
#include "cli/exit_code.h"
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

void writeSources(const std::filesystem::path& sources) {
  const std::filesystem::path options = sources / "docs/options.md", formats = sources / "docs/formats.md",
                              package = sources / "python/asdf_vk";
  const ReportModel model = reportModel(sources);
  writeText(options, optionPage(textOf(options)));
  writeText(formats, formatPage(textOf(formats), model));
  const std::filesystem::path schema = sources / "docs/schema.json";
  writeText(schema, jsonSchema(documentModel(sources), textOf(schema)));
  writeText(package / "_keywords.py", keywordModule());
  writeText(package / "_report.py", reportModule(model));
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
    if (argc == 2)
      writeSources(argv[1]);
    else
      writePages(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "asdfvk-write-documents: %s\n", error.what());
    return 1;
  }
}
