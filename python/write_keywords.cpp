// asdfvk-write-keywords FILE: writes asdf_vk/_keywords.py, which has the keywords of the options. The build runs this
// program.
#include <fstream>
#include <regex>

#include "core/text.h"
#include "describe/computation_options.h"

namespace asdfvk {
namespace {

/// The type of a keyword, for example "Literal["paper", "cgal"]".
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
                        wrapped(meaning, 112, "    ").substr(4));
  }
  return text;
}

}  // namespace
}  // namespace asdfvk

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  using namespace asdfvk;
  const ComputationSettings computation;
  const SessionSettings session;
  const std::string text =
      "\"\"\"Keywords of the options. Written by the build from src/describe/computation_options.cpp.\"\"\"\n\n"
      "from __future__ import annotations\n\nfrom typing import Literal, TypedDict\n" +
      keywordClass("ComputeOptions", "Options of the computation. The value None means the default of an option.",
                   computationRows(), &computation) +
      keywordClass("SessionOptions", "Options of a session.", sessionRows(), &session);
  return std::ofstream(argv[1]) << text << std::flush ? 0 : 1;
}
