// The man page in the macros of groff_man(7).
#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "documents/program.h"

namespace asdfvk {
namespace {

/// Text without markup, each character as itself: a hyphen stays a minus sign, so that options can be copied.
std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      default:
        result += c;
    }
  }
  return result.starts_with('.') ? "\\&" + result : result;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

std::string upperCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// Of the page: "asdf-vk-summarize" for "asdf-vk summarize".
std::string titleOf(const Program& program) {
  std::string title = program.name;
  std::replace(title.begin(), title.end(), ' ', '-');
  return title;
}

/// With a capital and a full stop.
std::string sentence(std::string text) {
  if (!text.empty()) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (!text.empty() && !text.ends_with('.')) text += '.';
  return text;
}

/// Literal values bold, placeholders italic.
std::string valuesText(const Values& values) {
  std::string text = values.placeholder, begin, end;
  if (values.areAttached) {
    text = text.substr(2, text.size() - 3);
    begin = "[=";
    end = "]";
  }
  std::string result;
  for (size_t i = 0; i <= text.size();) {
    const size_t bar = std::min(text.find('|', i), text.size());
    const std::string alternative = text.substr(i, bar - i);
    const bool isWord = std::find(values.words.begin(), values.words.end(), alternative) != values.words.end();
    result += (i > 0 ? "|" : "") + (isWord ? bold(alternative) : italic(alternative));
    i = bar + 1;
  }
  return begin + result + end;
}

std::string optionText(const DocumentedOption& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
  const std::string values = option.values.count == 0 ? "" : valuesText(option.values);
  const char* space = option.values.areAttached || names.empty() || values.empty() ? "" : " ";
  std::string text = fmt::format(".TP\n{}{}{}\n{}\n", names, space, values, plain(sentence(option.text)));
  for (const std::string& needed : option.needs) text += fmt::format("Needs {}.\n", bold(needed));
  return text;
}

std::string synopsis(const Program& program) {
  std::string text = fmt::format(".B {}\n", plain(program.name));
  for (const DocumentedOption& argument : program.arguments) text += valuesText(argument.values) + "\n";
  for (const DocumentedOption& option : program.options)
    if (option.isRequired) text += fmt::format("{} {}\n", bold(option.names.front()), valuesText(option.values));
  return text + "[\\fIOPTION\\fR]...\n";
}

std::string optionSections(const Program& program) {
  std::string text, group;
  for (const DocumentedOption& argument : program.arguments) text += optionText(argument);
  for (const DocumentedOption& option : program.options) {
    if (option.group != group) text += fmt::format(".SS \"{}\"\n", plain(option.group));
    group = option.group;
    text += optionText(option);
  }
  return text;
}

std::string definitions(const std::vector<std::pair<std::string, std::string>>& rows) {
  std::string text;
  for (const auto& [name, meaning] : rows) text += fmt::format(".TP\n{}\n{}\n", bold(name), plain(sentence(meaning)));
  return text;
}

}  // namespace

std::string manPage(const Program& program) {
  std::string page =
      fmt::format(".\\\" Generated from the options of {0}.\n.TH {1} 1 \"\" \"{0} {2}\" \"User Commands\"\n",
                  program.name, upperCase(plain(titleOf(program))), program.version);
  const auto add = [&page](const char* heading, const std::string& text) {
    if (!text.empty()) page += fmt::format(".SH {}\n{}", heading, text);
  };
  add("NAME", fmt::format("{} \\- {}\n", plain(titleOf(program)), plain(program.summary)));
  add("SYNOPSIS", synopsis(program));
  add("DESCRIPTION", plain(program.description) + "\n");
  add("OPTIONS", optionSections(program));
  std::vector<std::pair<std::string, std::string>> exitRows;
  for (const auto& [code, meaning] : program.exitCodes) exitRows.emplace_back(std::to_string(code), meaning);
  add("\"EXIT STATUS\"",
      definitions(exitRows) + (program.exitNote.empty() ? "" : ".PP\n" + plain(program.exitNote) + "\n"));
  add("ENVIRONMENT", definitions(program.environment));
  add("FILES", definitions(program.files));
  std::string examples;
  for (const auto& [text, command] : program.examples)
    examples += fmt::format(".PP\n{}\n.PP\n.in +4n\n.EX\n{}\n.EE\n.in\n", plain(text), plain(command));
  add("EXAMPLES", examples);
  std::string others;
  for (const std::string& other : program.seeAlso) {
    const size_t section = other.find('(');
    others += fmt::format("{}{}{}", others.empty() ? "" : ",\n", bold(other.substr(0, section)), other.substr(section));
  }
  add("\"SEE ALSO\"", others + "\n");
  return page;
}

}  // namespace asdfvk
