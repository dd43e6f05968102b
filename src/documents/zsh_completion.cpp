#include <fmt/core.h>

#include "core/text.h"
#include "documents/program.h"

namespace asdfvk {
namespace {

/// For a single-quoted argument of _arguments: characters with a meaning there are escaped.
std::string escaped(const std::string& text, const std::string& special) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (c == '\\' || special.find(c) != std::string::npos) result += '\\';
    result += c;
  }
  return result;
}

/// ":message:action"
std::string valueSpec(const Values& values) {
  const std::string words = joined(values.words, " ");
  std::string action = " ";
  if (!values.extensions.empty()) {
    action = fmt::format("_files -g \"(#i)*.({})\"", joined(values.extensions, "|"));
  } else if (values.areFiles) {
    action = "_files";
  } else if (values.areList) {
    action = "_sequence compadd - " + words;
  } else if (!values.words.empty()) {
    action = "(" + words + ")";
  }
  std::string spec;
  for (uint32_t i = 0; i < values.count; ++i)
    spec += fmt::format("{}{}:{}", values.areAttached ? "::" : ":", escaped(values.placeholder, ":"), action);
  return spec;
}

/// One line of _arguments per name, which excludes the other names.
std::string optionSpecs(const DocumentedOption& option) {
  std::string specs;
  for (const std::string& name : option.names) {
    const bool isLong = name.starts_with("--");
    const char* form = option.values.count == 0 ? "" : option.values.areAttached ? "=-" : isLong ? "=" : "+";
    const std::string others = option.names.size() > 1 ? fmt::format("({})", joined(option.names, " ")) : std::string();
    specs += fmt::format(" \\\n  '{}{}{}[{}]{}'", others, name, form, escaped(briefText(option), "[]"),
                         valueSpec(option.values));
  }
  return specs;
}

}  // namespace

std::string zshCompletion(const Program& program) {
  std::string text = fmt::format(
      "#compdef {0}\n# Completions of {0} for zsh. Generated from the options of the program.\n\n_arguments -s -S",
      program.name);
  for (const DocumentedOption& option : program.options) text += optionSpecs(option);
  for (const DocumentedOption& argument : program.arguments)
    text += fmt::format(" \\\n  '{}{}'", argument.isRequired ? "" : "*", valueSpec(argument.values));
  return text + "\n";
}

}  // namespace asdfvk
