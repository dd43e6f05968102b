#include "documents/program.h"

#include <algorithm>
#include <cctype>

#include "core/check.h"

namespace asdfvk {
namespace {

std::string oneLineOf(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::vector<std::string> alternativesOf(const std::string& text) {
  std::vector<std::string> result;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find('|', begin), text.size());
    result.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

bool isLiteral(const std::string& alternative) {
  return !alternative.empty() && std::all_of(alternative.begin(), alternative.end(),
                                             [](unsigned char c) { return std::islower(c) || c == '-'; });
}

DocumentedOption documented(const ArgumentDescription& argument) {
  ASDFVK_CHECK(argument.names.empty() || argument.names.back().starts_with("--"));
  DocumentedOption result{argument, {}};
  result.text = oneLineOf(argument.text);
  if (argument.valueCount == 0) return result;
  const bool hasCompletions = argument.completions.find('|') != std::string::npos;
  result.values = parseValues(hasCompletions ? argument.completions : argument.placeholder);
  result.values.areList = argument.placeholder.ends_with(",...");
  result.values.placeholder = argument.placeholder;
  result.values.count = argument.valueCount;
  return result;
}

}  // namespace

Values parseValues(const std::string& placeholder) {
  Values values;
  values.placeholder = placeholder;
  values.count = placeholder.empty() ? 0 : 1;
  std::string text = placeholder;
  if (text.starts_with("[=") && text.ends_with("]")) {
    values.areAttached = true;
    text = text.substr(2, text.size() - 3);
  }
  values.areList = text.ends_with(",...");
  for (const std::string& alternative : alternativesOf(text)) {
    if (isLiteral(alternative)) values.words.push_back(alternative);
    if (!alternative.starts_with("FILE")) continue;
    values.areFiles = true;
    if (alternative.starts_with("FILE.")) values.extensions.push_back(alternative.substr(5));
  }
  return values;
}

Program describe(const ArgumentParser& parser) {
  Program program;
  program.name = parser.name();
  program.description = oneLineOf(parser.description());
  for (const ArgumentDescription& argument : parser.describe())
    (argument.names.empty() ? program.arguments : program.options).push_back(documented(argument));
  return program;
}

}  // namespace asdfvk
