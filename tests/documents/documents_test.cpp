#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "asdf_vk/error.h"
#include "asdf_vk/version.h"
#include "cli/command_line.h"
#include "cli/exit_code.h"
#include "core/json.h"
#include "documents/documents.h"
#include "generate/generator_options.h"
#include "serve/json_schema.h"

namespace fs = std::filesystem;

namespace asdfvk {
namespace {

const std::string kSources = ASDFVK_SOURCE_DIR;

std::string contentOf(const std::string& path) {
  std::ifstream in(kSources + "/" + path);
  REQUIRE_MESSAGE(in.good(), path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string helpOf(bool ofGenerator) {
  CommandLine line;
  GeneratorOptions generator;
  return ofGenerator ? parserOf(generator).help() : parserOf(line).help();
}

std::string pageOf(bool ofGenerator) {
  return manPage(contentOf(ofGenerator ? "docs/man/asdf-vk-generate.1" : "docs/man/asdf-vk.1"), "1.2.3",
                 helpOf(ofGenerator), {{0, "done"}, {6, "too-thin"}});
}

/// The first group of every match of the pattern.
std::set<std::string> allMatches(const std::string& text, const std::string& pattern) {
  std::set<std::string> result;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
    result.insert((*match)[1]);
  return result;
}

TEST_CASE("the man pages have the options of --help=all, and no other") {
  for (const bool ofGenerator : {false, true}) {
    std::set<std::string> expected = allMatches(helpOf(ofGenerator), "\n  (-[a-zA-Z0-9,-]+)");
    REQUIRE_GE(expected.size(), 8);
    std::set<std::string> found;
    for (const std::string& name : allMatches(pageOf(ofGenerator), "\\.TP\n\\\\fB(\\\\-[^ ]*)\\\\fR"))
      found.insert(std::regex_replace(name, std::regex("\\\\-"), "-"));
    CHECK(found == expected);
  }
}

TEST_CASE("the man page has its sections, version, exit codes and groups, and no mark") {
  const std::string page = pageOf(false);
  for (const char* part :
       {"asdf-vk 1.2.3", ".SH OPTIONS\n.TP\n", ".TP\n\\fB6\\fR\ntoo\\-thin.\n", ".SS \"Many meshes\"\n", "CGAL\\(aqs"})
    CHECK_MESSAGE(page.find(part) != std::string::npos, part);
  for (const char* mark : {"@OPTIONS@", "@EXIT_CODES@", "@VERSION@"}) CHECK(page.find(mark) == std::string::npos);
}

TEST_CASE("options in the pages of docs/man exist") {
  const std::set<std::string> known = allMatches(helpOf(false), "\n  (?:-.,)?(--[a-z-]+)");
  const std::string page = std::regex_replace(contentOf("docs/man/asdf-vk.1"), std::regex("\\\\-"), "-");
  for (const std::string& name : allMatches(page, "[ \n](--[a-z-]+)")) CHECK_MESSAGE(known.contains(name), name);
}

TEST_CASE("the written files are up to date; asdfvk-write-documents SOURCES writes them") {
  const ReportModel model = reportModel(kSources);
  const std::string page = contentOf("docs/options.md"), formats = contentOf("docs/formats.md");
  CHECK(optionPage(page) == page);
  CHECK(formatPage(formats, model) == formats);
  CHECK(keywordModule() == contentOf("python/asdf_vk/_keywords.py"));
  CHECK(reportModule(model) == contentOf("python/asdf_vk/_report.py"));
  const std::string schema = contentOf("docs/schema.json");
  CHECK(jsonSchema(documentModel(kSources), schema) == schema);
  CHECK(schemaText() == schema);
  CHECK(page.find("| `--wall-angle DEGREES` | 120 | above 90 and at most 180 |") != std::string::npos);
}

TEST_CASE("keys of released versions are neither removed nor changed while the format version stays") {
  const ReportModel model = documentModel(kSources);
  const Json schema = Json::parse(contentOf("docs/schema.json"));
  const auto isAllowed = [&](Json changed, int formatVersion = kJsonFormatVersion) {
    changed["x-formatVersion"] = formatVersion;
    try {
      (void)jsonSchema(model, jsonText(changed));
      return true;
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find("Finding") != std::string::npos);
      return false;
    }
  };
  const auto withKey = [&](const char* key, const Json& property) {
    Json changed = schema;
    changed["$defs"]["Finding"]["properties"][key].update(property);
    return changed;
  };
  CHECK(isAllowed(schema));
  CHECK_FALSE(isAllowed(withKey("gone", {{"x-since", "0.1.0"}})));
  CHECK(isAllowed(withKey("gone", {{"x-since", "0.1.0"}}), kJsonFormatVersion - 1));
  CHECK(isAllowed(withKey("gone", {{"x-since", ASDFVK_VERSION}})));
  CHECK(isAllowed(withKey("message", {{"x-since", "0.1.0"}, {"description", "another text"}})));
  CHECK_FALSE(isAllowed(withKey("message", {{"x-since", "0.1.0"}, {"type", "integer"}})));
  Json optional = withKey("message", {{"x-since", "0.1.0"}});
  optional["$defs"]["Finding"]["required"].clear();
  CHECK_FALSE(isAllowed(optional));
  Json kinds = schema;
  kinds["$defs"]["FindingKind"]["enum"].push_back("gone");
  CHECK(isAllowed(kinds));
  kinds["$defs"]["FindingKind"]["x-since"] = "0.1.0";
  CHECK_FALSE(isAllowed(kinds));
  const std::string since = R"("x-since": "0.1.0")";
  CHECK(jsonSchema(model, jsonText(withKey("message", {{"x-since", "0.1.0"}}))).find(since) != std::string::npos);
}

TEST_CASE(
    "the model of the report has each structure once, after those of its members, with the comments of the header") {
  const ReportModel model = reportModel(kSources);
  CHECK_EQ(model.structures.back().name, "Report");
  std::set<std::string> known;
  for (const ReportEnumeration& row : model.enumerations) CHECK(known.insert(row.name).second);
  for (const ReportStructure& structure : model.structures) {
    CAPTURE(structure.name);
    CHECK_FALSE(structure.comment.empty());
    for (const ReportMember& member : structure.members) CHECK((member.inner.empty() || known.contains(member.inner)));
    CHECK(known.insert(structure.name).second);
  }
  const std::vector<ReportMember>& members = model.structures.back().members;
  const auto seeds =
      std::find_if(members.begin(), members.end(), [](const auto& row) { return row.name == "seedCount"; });
  REQUIRE(seeds != members.end());
  CHECK_EQ(seeds->comment, "Triangles that cast rays.");
  CHECK_EQ(seeds->pythonType, "int");
}

/// Standard output and error of a shell command, and its exit code.
std::pair<std::string, int> outputOf(const std::string& command) {
  FILE* pipe = popen(("exec 2>&1; " + command).c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) output += static_cast<char>(c);
  const int status = pclose(pipe);
  return {output, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

bool isInstalled(const std::string& program) {
  if (outputOf("command -v " + program).second == 0) return true;
  MESSAGE(program, " is not installed: skipped");
  return false;
}

/// A file with the text, removed at the end.
class TextFile {
 public:
  explicit TextFile(const std::string& text) {
    REQUIRE(mkdtemp(folder_.data()) != nullptr);
    std::ofstream(path()) << text;
  }
  ~TextFile() { fs::remove_all(folder_); }
  [[nodiscard]] std::string path() const { return folder_ + "/text"; }

 private:
  std::string folder_ = (fs::temp_directory_path() / "asdfvk-documents-XXXXXX").string();
};

TEST_CASE("groff accepts the man pages, and bash its completion") {
  if (isInstalled("groff")) {
    for (const bool ofGenerator : {false, true}) {
      const TextFile file(pageOf(ofGenerator));
      CHECK_EQ(outputOf("groff -man -Tutf8 -ww -z " + file.path()), std::pair<std::string, int>{"", 0});
    }
    const TextFile wrong(".TP\n.wrongMacro\n");
    CHECK_NE(outputOf("groff -man -Tutf8 -ww -z " + wrong.path()), std::pair<std::string, int>{"", 0});
  }
  if (isInstalled("bash"))
    CHECK_EQ(outputOf("bash -n " + kSources + "/src/documents/completion.bash"), std::pair<std::string, int>{"", 0});
}

TEST_CASE("bash completes options, and values that have names") {
  if (!isInstalled("bash")) return;
  const TextFile help(helpOf(false));
  const TextFile script("asdf-vk() { [[ $1 == mcp ]] && echo '  --root DIR' || cat '" + help.path() + "'; }\nsource " +
                        kSources +
                        R"bash(/src/documents/completion.bash
try() {
  COMP_WORDS=(asdf-vk "$@")
  COMP_CWORD=$#
  _asdf_vk
  mapfile -t COMPREPLY < <(printf '%s\n' "${COMPREPLY[@]}" | LC_ALL=C sort)
  (IFS='|' && echo "${COMPREPLY[*]}")
}
try --reci
try --recipe ''
try --recipe = q
try --check = ''
try -o ''
try ''
try --rays ''
try --picture-up -
try -- --reci
cd /
try summ
try mcp --ro
try mcp --reci
)bash");
  CHECK_EQ(outputOf("bash " + script.path()).first,
           "--recipe\nbalanced|paper|quality\nquality\nall\n\n\n\n-x|-y|-z\n\nsummarize\n--root\n\n");
}

}  // namespace
}  // namespace asdfvk
