#include <fmt/core.h>

#include <regex>
#include <sstream>

#include "documents/documents.h"

namespace asdfvk {
namespace {

/// Escapes a line of text for groff_man(7). A hyphen becomes a minus sign, so that options can be copied.
std::string plain(const std::string& text) {
  static const std::pair<char, const char*> kEscapes[]{{'\\', "\\e"},  {'-', "\\-"},   {'\'', "\\(aq"},
                                                       {'`', "\\(ga"}, {'^', "\\(ha"}, {'~', "\\(ti"}};
  std::string result = text.starts_with('.') ? "\\&" : "";
  for (const char c : text) {
    const auto* const escape =
        std::find_if(std::begin(kEscapes), std::end(kEscapes), [&](auto& e) { return e.first == c; });
    result += escape == std::end(kEscapes) ? std::string(1, c) : escape->second;
  }
  return result;
}

/// Converts the help of an ArgumentParser to man format. Group titles become headings, and options become bold.
std::string optionSections(const std::string& help) {
  std::string sections, line;
  bool hasBegun = false;
  for (std::istringstream lines(help); std::getline(lines, line);) {
    if (line.starts_with("      ")) {
      if (hasBegun) sections += plain(line.substr(6)) + "\n";
    } else if (line.starts_with("  ")) {
      const size_t end = std::min(line.find_first_of(" [", 3), line.size());
      hasBegun = true;
      sections += fmt::format(".TP\n\\fB{}\\fR{}\n", plain(line.substr(2, end - 2)), plain(line.substr(end)));
    } else if (line.ends_with(':')) {
      sections += fmt::format(".SS \"{}\"\n", plain(line.substr(0, line.size() - 1)));
    }
  }
  return sections;
}

std::string replaced(std::string page, const std::string& mark, const std::string& text) {
  const size_t at = page.find(mark);
  return at == std::string::npos ? page : page.replace(at, mark.size(), text);
}

}  // namespace

std::string manPage(const std::string& page, const std::string& version, const std::string& help,
                    const std::vector<std::pair<int, std::string>>& exitCodes) {
  std::string codes;
  for (const auto& [code, meaning] : exitCodes) codes += fmt::format(".TP\n\\fB{}\\fR\n{}.\n", code, plain(meaning));
  return replaced(replaced(replaced(page, "@VERSION@", version), "@OPTIONS@\n", optionSections(help)), "@EXIT_CODES@\n",
                  codes);
}

}  // namespace asdfvk
