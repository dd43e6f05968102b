#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "cli/options.h"
#include "cli/summarize.h"
#include "documents/program.h"
#include "generate/generator_options.h"

namespace fs = std::filesystem;

namespace asdfvk {
namespace {

using Names = std::set<std::string>;

/// A program and its help, from which the tests read the options a second time.
struct Subject {
  Program program;
  std::string help;
};

/// Programs, which have completions, too.
std::vector<Subject> subjects() {
  std::vector<Program> programs = documentedPrograms();
  REQUIRE_EQ(programs.size(), 2);
  GeneratorOptions options;
  ArgumentParser generator;
  addOptions(generator, options);
  return {{programs[0], parseCommandLine({"--help=all"}).answer.value()}, {programs[1], generator.help()}};
}

Subject summarizeSubject() {
  SummaryOptions options;
  ArgumentParser parser;
  addOptions(parser, options);
  return {documentedSummarize(), parser.help()};
}

/// Programs and commands, which have man pages.
std::vector<Subject> subjectsOfPages() {
  std::vector<Subject> all = subjects();
  all.push_back(summarizeSubject());
  return all;
}

/// Names and placeholders: "--seeds" to "N%|N|all", "-o" and "--output" to "FILE|DIR|-".
std::map<std::string, std::string> optionsOf(const std::string& help) {
  std::map<std::string, std::string> result;
  std::istringstream lines(help);
  const std::regex row("  (-[^ ]+)( ([^ ]+( [A-Z])*))?.*");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!line.starts_with("  -")) continue;
    REQUIRE_MESSAGE(std::regex_match(line, match, row), line);
    std::istringstream names(match[1]);
    for (std::string name; std::getline(names, name, ',');) result[name] = match[3];
  }
  return result;
}

Names namesOf(const std::map<std::string, std::string>& options) {
  Names names;
  for (const auto& [name, placeholder] : options) names.insert(name);
  return names;
}

/// The text of every group in every match of the pattern.
Names allMatches(const std::string& text, const std::string& pattern) {
  Names result;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
    for (size_t group = 1; group < match->size(); ++group)
      if ((*match)[group].matched) result.insert((*match)[group]);
  return result;
}

/// Options of the page: a line after .TP begins with them, separated by commas.
Names namesInManPage(const std::string& page) {
  Names names;
  for (const std::string& line : allMatches(page, "\\.TP\n((?:\\\\fB\\\\-[a-z0-9\\\\-]+\\\\fR(?:, )?)+)"))
    for (const std::string& name : allMatches(line, "\\\\fB([a-z0-9\\\\-]+)\\\\fR"))
      names.insert(std::regex_replace(name, std::regex("\\\\-"), "-"));
  return names;
}

Names namesInBash(const std::string& text) {
  const Names lists = allMatches(text, "_words '(-h [^']*)'");
  REQUIRE_EQ(lists.size(), 1);
  return allMatches(*lists.begin(), "(-[a-z0-9-]+)");
}

TEST_CASE("the man page and the completions have the options of --help=all, and no other") {
  for (const Subject& subject : subjects()) {
    const Program& program = subject.program;
    INFO(program.name);
    const Names expected = namesOf(optionsOf(subject.help));
    REQUIRE_GE(expected.size(), 8);
    CHECK(namesInManPage(manPage(program)) == expected);
    CHECK(namesInBash(bashCompletion(program)) == expected);
  }
}

TEST_CASE("the man page of summarize has the options of its help, and no other") {
  const auto [program, help] = summarizeSubject();
  const Names expected = namesOf(optionsOf(help));
  REQUIRE_GE(expected.size(), 6);
  const std::string page = manPage(program);
  CHECK(namesInManPage(page) == expected);
  CHECK(page.find("\n.TH ASDF\\-VK\\-SUMMARIZE 1 ") != std::string::npos);
  CHECK(page.find(".B asdf\\-vk summarize\n") != std::string::npos);
}

TEST_CASE("an option with choices completes to them") {
  size_t choiceCount = 0;
  for (const auto& [program, help] : subjects()) {
    const std::string bash = bashCompletion(program);
    for (const auto& [option, value] : optionsOf(help)) {
      const std::string &name = option, &placeholder = value;
      if (!std::regex_match(placeholder, std::regex("[a-z-]+(\\|[a-z-]+)+"))) continue;
      INFO(name, " ", placeholder);
      const std::string words = std::regex_replace(placeholder, std::regex("\\|"), " ");
      CHECK(bash.find(name + " | " + name + "=) _asdf_vk_words '" + words + "' ;;") != std::string::npos);
      ++choiceCount;
    }
  }
  CHECK_GE(choiceCount, 15);
}

TEST_CASE("values are read from a placeholder") {
  CHECK(parseValues("").count == 0);
  CHECK(parseValues("N%|N|all").words == std::vector<std::string>{"all"});
  CHECK(parseValues("auto|x|-x").words == std::vector<std::string>{"auto", "x", "-x"});
  CHECK(parseValues("off|auto|RxP").words == std::vector<std::string>{"off", "auto"});
  CHECK(parseValues("E%[rel]").words.empty());
  CHECK_FALSE(parseValues("E%[rel]").areAttached);
  CHECK(parseValues("[=N|all]").areAttached);
  CHECK(parseValues("[=N|all]").words == std::vector<std::string>{"all"});
  CHECK(parseValues("NAME,...").areList);
  CHECK(parseValues("FILE|DIR|-").areFiles);
  CHECK(parseValues("FILE|DIR|-").extensions.empty());
  CHECK(parseValues("FILE.ply|FILE.off|-").extensions == std::vector<std::string>{"ply", "off"});
  CHECK_FALSE(parseValues("DEGREES").areFiles);
}

TEST_CASE("the man page has its sections, exit codes and groups") {
  for (const auto& [program, help] : subjectsOfPages()) {
    const std::string page = manPage(program);
    for (const char* section :
         {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "\"EXIT STATUS\"", "EXAMPLES", "\"SEE ALSO\""})
      CHECK_MESSAGE(page.find(std::string(".SH ") + section + "\n") != std::string::npos, section);
    for (const auto& [code, meaning] : program.exitCodes)
      CHECK(page.find(".TP\n\\fB" + std::to_string(code) + "\\fR\n") != std::string::npos);
  }
  const Subject subject = subjects().front();
  CHECK(allMatches(manPage(subject.program), "\n\\.SS \"([^\"]*)\"") == [&] {
    Names groups = allMatches(subject.help, "\n([A-Z][^\n]*):\n");
    groups.erase("Positionals");
    return groups;
  }());
  for (const char* code : {"0", "6", "70", "130"}) CHECK(subject.help.find(code) != std::string::npos);
}

TEST_CASE("text is escaped for man") {
  Program program = subjects().front().program;
  DocumentedOption option;
  option.names = {"--odd"};
  option.text = ".it's a \\ [b]: 'c' ~ ^ ` \"d\" $e";
  program.options = {option};
  CHECK(manPage(program).find("\\&.it\\(aqs a \\e [b]: \\(aqc\\(aq \\(ti \\(ha \\(ga \"d\" $e.\n") !=
        std::string::npos);
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

TEST_CASE("groff and bash accept the documents") {
  using Writer = std::string (*)(const Program&);
  const std::vector<std::pair<std::string, Writer>> checks{{"groff -man -Tutf8 -ww -z", manPage},
                                                           {"bash -n", bashCompletion}};
  for (const auto& [checker, write] : checks) {
    const std::string& command = checker;
    if (!isInstalled(command.substr(0, command.find(' ')))) continue;
    for (const Subject& subject : write == &manPage ? subjectsOfPages() : subjects()) {
      const TextFile file(write(subject.program));
      const auto [output, code] = outputOf(command + " " + file.path());
      INFO(command, " ", subject.program.name);
      CHECK_EQ(code, 0);
      CHECK_EQ(output, "");
    }
    const TextFile wrong("if (( '\n.TP\n.wrongMacro\n");
    CHECK_NE(outputOf(command + " " + wrong.path()), std::pair<std::string, int>{"", 0});
  }
}

TEST_CASE("bash completes options, choices, lists and files") {
  if (!isInstalled("bash")) return;
  const TextFile script(bashCompletion(subjects().front().program) + R"bash(
cd "$(mktemp -d)" && touch a.ply 'b c.OFF' d.txt e.png && mkdir f
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
try --recipe=q
try --fields seed,s
try ''
try --picture ''
try -o d
try --rays ''
try --check = a
try -- --reci
rm -r "$PWD"
)bash");
  CHECK_EQ(outputOf("bash " + script.path()).first,
           "--recipe\n"
           "balanced|paper|quality\n"
           "quality\n"
           "--recipe=quality\n"
           "seed,sdf|seed,seed|seed,segment\n"
           "a.ply|b c.OFF|f\n"
           "e.png|f\n"
           "d.txt\n"
           "\n"
           "all\n"
           "\n");
}

}  // namespace
}  // namespace asdfvk
