// Modules of the Python package: the keywords of the options, and the dataclasses of the report.
#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "core/text.h"
#include "describe/session_options.h"
#include "documents/documents.h"

namespace asdfvk {
namespace {

constexpr size_t kColumnCount = 120;
constexpr const char* kIndent = "    ";

/// The type of a keyword, for example "Literal["paper", "cgal"]".
std::string keywordType(const OptionRow& row) {
  const OptionCodec& codec = row.member.codec();
  if (codec.pythonType != nullptr) return codec.pythonType;
  const std::vector<std::string> names = namesOf(row);
  if (!names.empty()) return "Literal[\"" + joined(names, "\", \"") + "\"]";
  switch (codec.kind) {
    case OptionKind::Flag:
      return "bool";
    case OptionKind::Real:
      return "float";
    case OptionKind::Whole:
      return "int";
    case OptionKind::Text:
      break;
  }
  return "str";
}

std::string keywordClass(const char* name, const char* comment, const OptionRows& rows) {
  std::string text = fmt::format("\n\nclass {}(TypedDict, total=False):\n    \"\"\"{}\"\"\"\n\n", name, comment);
  for (const OptionRow& row : rows) {
    const std::string keyword = spelled(row, OptionSpelling::SnakeCase);
    if (keyword.empty()) continue;
    const bool isNegated = row.flags != nullptr && std::string_view(row.flags).starts_with("--no-");
    std::string meaning = isNegated ? std::string("False: ") + row.text : row.text;
    if (const std::string range = rangeText(row); !range.empty()) meaning += "; " + range;
    if (*row.needs != 0) meaning += "; needs " + neededText(row, rows, OptionSpelling::SnakeCase);
    if (const std::string value = defaultText(row); value != "-" && !isFlag(row)) meaning += "; default " + value;
    text += fmt::format("    {}: {} | None\n    \"\"\"{}.\"\"\"\n", keyword, keywordType(row),
                        wrapped(withSpelledOptions(rows, meaning, OptionSpelling::SnakeCase), 112, kIndent).substr(4));
  }
  return text;
}

std::string snakeCase(std::string_view name) {
  std::string text;
  for (const char c : name) text += 'A' <= c && c <= 'Z' ? "_" + lowerCase(std::string_view(&c, 1)) : std::string(1, c);
  return text;
}

std::string docstring(const std::string& comment) {
  std::string text = "\"\"\"";
  for (const char c : comment) text += c == '\\' ? "\\\\" : std::string(1, c);
  const std::string end = comment.ends_with('"') ? " \"\"\"" : "\"\"\"";
  if (4 + text.size() + end.size() <= kColumnCount) return kIndent + text + end + "\n";
  return wrapped(text, kColumnCount, kIndent) + "\n" + kIndent + "\"\"\"\n";
}

std::string literal(const ReportEnumeration& row) {
  const std::string names = "\"" + joined(row.names, "\", \"") + "\"", line = row.name + " = Literal[" + names + "]";
  if (line.size() <= kColumnCount) return line + "\n";
  return row.name + " = Literal[\n" + wrapped(names + ",", kColumnCount - 4, kIndent) + "\n]\n";
}

}  // namespace

std::string keywordModule() {
  ComputationSettings computation;
  SessionSettings session;
  return "\"\"\"Keywords of the options. Written by asdfvk-write-documents.\"\"\"\n\n"
         "from __future__ import annotations\n\nfrom typing import Literal, TypedDict\n" +
         keywordClass("ComputeOptions", "Options of the computation. The value None means the default of an option.",
                      computationRows(computation)) +
         keywordClass("SessionOptions", "Options of a session.", sessionRows(session));
}

std::string reportModule(const ReportModel& model) {
  std::string text =
      "\"\"\"Typed reports. Written by asdfvk-write-documents from the headers of the library.\n\n"
      "Lengths are in the unit of the mesh; numbers of faces and `face` refer to input faces.\n\"\"\"\n\n"
      "from __future__ import annotations\n\nfrom dataclasses import dataclass\nfrom typing import Literal, Tuple\n\n"
      "Point = Tuple[float, float, float]\n";
  std::set<std::string> used;
  for (const ReportStructure& structure : model.structures)
    for (const ReportMember& member : structure.members) used.insert(member.inner);
  for (const ReportEnumeration& row : model.enumerations)
    if (used.contains(row.name)) text += literal(row);
  for (const ReportStructure& structure : model.structures) {
    text += fmt::format("\n\n@dataclass(frozen=True)\nclass {}:\n{}\n", structure.name, docstring(structure.comment));
    for (size_t i = 0; i < structure.members.size(); ++i) {
      const ReportMember& member = structure.members[i];
      text += fmt::format("    {}: {}\n", snakeCase(member.name), member.pythonType);
      const bool sharesComment = i + 1 < structure.members.size() && structure.members[i + 1].comment == member.comment;
      if (!sharesComment) text += docstring(member.comment);
    }
  }
  return text;
}

}  // namespace asdfvk
