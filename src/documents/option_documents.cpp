// What documents and Python repeat of the options.
#include <fmt/core.h>

#include <algorithm>
#include <regex>

#include "cli/options.h"
#include "core/text.h"
#include "documents/program.h"

namespace asdfvk {
namespace {

std::string escaped(const std::string& text) { return std::regex_replace(text, std::regex("\\|"), "\\|"); }

std::string tableRow(const OptionRow& row, const OptionTable& table) {
  std::string names = "`" + std::regex_replace(row.flags != nullptr ? row.flags : spelled(row, OptionSpelling::Flag),
                                               std::regex(","), "`, `");
  const std::string placeholder = placeholderOf(row);
  const char* const space = placeholder.starts_with('[') || isFlag(row) ? "" : " ";
  names += space + placeholder + "`";
  std::string meaning = row.text + std::string(".");
  if (*row.needs != 0) meaning += " Needs `" + neededText(row, table.rows, OptionSpelling::Flag) + "`.";
  if (*row.more != 0) meaning += std::string(" ") + row.more;
  const std::string range = rangeText(row);
  return fmt::format("| {} | {} | {} | {} |\n", escaped(names), isFlag(row) ? "off" : defaultText(row, table.target),
                     range.empty() ? "-" : range, escaped(meaning));
}

/// "Literal["paper", "cgal"]"
std::string keywordType(const OptionRow& row) {
  if (row.keywordType != nullptr) return row.keywordType;
  if (isFlag(row)) return "bool";
  const std::vector<std::string> names = namesOf(row);
  if (!names.empty()) return "Literal[\"" + joined(names, "\", \"") + "\"]";
  switch (row.access.kind) {
    case OptionKind::Real:
      return "float";
    case OptionKind::Whole:
      return "int";
    default:
      return "str";
  }
}

std::string wrappedAt(const std::string& text, size_t width, const std::string& indent) {
  std::string lines, line;
  size_t begin = 0;
  while (begin < text.size()) {
    const size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && line.size() + 1 + word.size() > width) {
      lines += line + "\n" + indent;
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return lines + line;
}

std::string keywordClass(const char* name, const char* comment, OptionRows rows, const void* defaults) {
  std::string text = fmt::format("\n\nclass {}(TypedDict, total=False):\n    \"\"\"{}\"\"\"\n\n", name, comment);
  for (const OptionRow& row : rows) {
    const std::string keyword = spelled(row, OptionSpelling::SnakeCase);
    if (keyword.empty()) continue;
    const bool isNegated = row.flags != nullptr && std::string_view(row.flags).starts_with("--no-");
    std::string meaning = isNegated ? std::string("False: ") + row.text : row.text;
    for (const OptionRow& other : rows)
      if (const std::string flag = spelled(other, OptionSpelling::Flag); !flag.empty())
        meaning =
            std::regex_replace(meaning, std::regex(flag + "(?![a-z-])"), spelled(other, OptionSpelling::SnakeCase));
    if (const std::string range = rangeText(row); !range.empty()) meaning += "; " + range;
    if (*row.needs != 0) meaning += "; needs " + neededText(row, rows, OptionSpelling::SnakeCase);
    if (const std::string value = defaultText(row, defaults); value != "-" && !isFlag(row))
      meaning += "; default " + value;
    text += fmt::format("    {}: {} | None\n    \"\"\"{}.\"\"\"\n", keyword, keywordType(row),
                        wrappedAt(meaning, 108, "    "));
  }
  return text;
}

}  // namespace

std::string optionPage(std::string page) {
  CommandLine defaults;
  const std::vector<OptionTable> tables = optionTables(defaults);
  for (size_t begin = 0; (begin = page.find("<!-- options of ", begin)) != std::string::npos;) {
    const size_t nameBegin = begin + std::string_view("<!-- options of ").size(),
                 nameEnd = page.find(" -->", nameBegin);
    const std::string name = page.substr(nameBegin, nameEnd - nameBegin);
    std::string text = "\n| option | default | range | meaning |\n|---|---|---|---|\n";
    for (const OptionTable& table : tables)
      for (const OptionRow& row : table.rows)
        if (!spelled(row, OptionSpelling::Flag).empty() && std::string_view(row.group).substr(0, name.size()) == name)
          text += tableRow(row, table);
    const size_t contentBegin = nameEnd + 4, contentEnd = page.find("<!-- end -->", contentBegin);
    page.replace(contentBegin, contentEnd - contentBegin, text);
    begin = contentBegin + text.size();
  }
  return page;
}

std::string keywordModule() {
  const ComputationSettings computation;
  const SessionSettings session;
  return "\"\"\"Keywords of the options. Written by asdfvk-write-documents from "
         "src/describe/computation_options.cpp.\"\"\"\n\n"
         "from __future__ import annotations\n\nfrom typing import Literal, TypedDict\n" +
         keywordClass("ComputeOptions",
                      "Options of the computation. None, as well as leaving an option out, is its default.",
                      computationRows(), &computation) +
         keywordClass("SessionOptions", "Options of a session.", sessionRows(), &session);
}

}  // namespace asdfvk
