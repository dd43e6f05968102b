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

DocumentedOption describeOption(const CLI::Option& option) {
  DocumentedOption result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  ASDFVK_CHECK(option.get_positional() || result.names.back().starts_with("--"));
  if (option.get_items_expected_max() > 0) {
    const std::string types = option.get_type_name(), placeholder = option.get_option_text();
    result.values = parseValues(types.find('|') == std::string::npos ? placeholder : types);
    result.values.areList = placeholder.ends_with(",...");
    result.values.placeholder = placeholder;
    result.values.count = option.get_positional() ? 1 : static_cast<uint32_t>(option.get_items_expected_max());
  }
  result.text = oneLineOf(option.get_description());
  result.group = option.get_group();
  for (const CLI::Option* needed : option.get_needs()) result.needs.push_back(needed->get_name());
  result.isRequired = option.get_required();
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

Program describe(const CLI::App& app) {
  Program program;
  program.name = app.get_name();
  program.description = oneLineOf(app.get_description());
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? program.arguments : program.options).push_back(describeOption(*option));
  // The order of groups is that of the help.
  const std::vector<std::string> groups = app.get_groups();
  const auto rank = [&](const DocumentedOption& option) {
    return std::find(groups.begin(), groups.end(), option.group) - groups.begin();
  };
  std::stable_sort(program.options.begin(), program.options.end(),
                   [&](const DocumentedOption& a, const DocumentedOption& b) { return rank(a) < rank(b); });
  return program;
}

std::string briefText(const DocumentedOption& option) {
  const std::string& text = option.text;
  return text.substr(0, std::min({text.find(". "), text.find(';'), text.size()}));
}

}  // namespace asdfvk
