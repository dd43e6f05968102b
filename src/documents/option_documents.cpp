#include <fmt/core.h>

#include <algorithm>
#include <regex>

#include "cli/command_line.h"
#include "core/text.h"
#include "documents/documents.h"

namespace asdfvk {
namespace {

std::string escaped(const std::string& text) { return std::regex_replace(text, std::regex("\\|"), "\\|"); }

std::string tableRow(const OptionRow& row, const OptionRows& rows) {
  std::string names = "`" + std::regex_replace(row.flags != nullptr ? row.flags : spelled(row, OptionSpelling::Flag),
                                               std::regex(","), "`, `");
  const std::string placeholder = placeholderOf(row);
  const char* const space = placeholder.starts_with('[') || isFlag(row) ? "" : " ";
  names += space + placeholder + "`";
  std::string meaning = row.text + std::string(".");
  if (*row.needs != 0) meaning += " Needs `" + neededText(row, rows, OptionSpelling::Flag) + "`.";
  if (*row.more != 0) meaning += std::string(" ") + row.more;
  const std::string range = rangeText(row);
  return withSpelledOptions(
      rows,
      fmt::format("| {} | {} | {} | {} |\n", escaped(names), isFlag(row) ? "off" : defaultText(row),
                  range.empty() ? "-" : range, escaped(meaning)),
      OptionSpelling::Flag);
}

}  // namespace

std::string optionPage(std::string page) {
  CommandLine defaults;
  const std::vector<OptionRows> tables = optionTables(defaults);
  for (size_t begin = 0; (begin = page.find("<!-- options of ", begin)) != std::string::npos;) {
    const size_t nameBegin = begin + std::string_view("<!-- options of ").size(),
                 nameEnd = page.find(" -->", nameBegin);
    const std::string name = page.substr(nameBegin, nameEnd - nameBegin);
    std::string text = "\n| option | default | range | meaning |\n|---|---|---|---|\n";
    for (const OptionRows& rows : tables)
      for (const OptionRow& row : rows)
        if (!spelled(row, OptionSpelling::Flag).empty() && std::string_view(row.group).substr(0, name.size()) == name)
          text += tableRow(row, rows);
    const size_t contentBegin = nameEnd + 4, contentEnd = page.find("<!-- end -->", contentBegin);
    page.replace(contentBegin, contentEnd - contentBegin, text);
    begin = contentBegin + text.size();
  }
  return page;
}

}  // namespace asdfvk
