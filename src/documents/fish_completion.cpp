#include <fmt/core.h>

#include <algorithm>

#include "core/text.h"
#include "documents/program.h"

namespace asdfvk {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

/// The option of `complete` with the candidates, or nothing.
std::string candidates(const Values& values, const std::string& function) {
  const std::string words = joined(values.words, " ");
  if (!values.extensions.empty()) return fmt::format(" -a '({}_files {})'", function, joined(values.extensions, " "));
  if (values.areList) return fmt::format(" -a '(__fish_append , {})'", words);
  return words.empty() ? "" : fmt::format(" -a '{}'", words);
}

std::string optionLine(const Program& program, const DocumentedOption& option, const std::string& function) {
  std::string line = "complete -c " + program.name;
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  // -x: a value and no files; -r: a value, also files; -f alone: an optional value after an equals sign.
  const Values& values = option.values;
  const bool anyFile = values.areFiles && values.extensions.empty();
  if (values.count > 0) line += values.areAttached ? " -f" : anyFile ? " -r -F" : " -x";
  if (!anyFile) line += candidates(values, function);
  return line + " -d " + quoted(briefText(option)) + "\n";
}

/// Folders, and files with one of the extensions in any case.
constexpr const char* kFiles = R"(
function {0}_files
  set -l extensions (string join '|' $argv)
  complete -C "'' "(commandline -ct) | string match -r -i "^[^\t]*(?:/|\.(?:$extensions))(?:\t.*)?\$"
end

)";

}  // namespace

std::string fishCompletion(const Program& program) {
  std::string function = "__" + program.name;
  std::replace(function.begin(), function.end(), '-', '_');
  std::string text =
      fmt::format("# Completions of {} for fish. Generated from the options of the program.\n", program.name);
  text += fmt::format(kFiles, function);
  for (const DocumentedOption& argument : program.arguments)
    text += fmt::format("complete -c {} -f{}\n", program.name, candidates(argument.values, function));
  for (const DocumentedOption& option : program.options) text += optionLine(program, option, function);
  return text;
}

}  // namespace asdfvk
