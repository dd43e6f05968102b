// The tables of docs/formats.md.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/check.h"
#include "core/text.h"
#include "describe/computation_options.h"
#include "describe/fields.h"
#include "documents/documents.h"

namespace asdfvk {
namespace {

/// Members of one line of the header have one row.
std::string rowsOf(const ReportStructure& structure) {
  std::string rows;
  for (size_t i = 0; i < structure.members.size();) {
    const ReportMember& first = structure.members[i];
    std::string names = "`" + first.name + "`";
    while (++i < structure.members.size() && structure.members[i].comment == first.comment)
      names += ", `" + structure.members[i].name + "`";
    rows += fmt::format("| {} | {} | {} |\n", names, first.documentType, first.comment);
  }
  return rows;
}

std::string keyTables(const ReportModel& model) {
  constexpr const char* kHead = " | type | meaning |\n|---|---|---|\n";
  std::map<std::string, std::vector<std::string>> keysOf;
  for (const ReportStructure& structure : model.structures)
    for (const ReportMember& member : structure.members) keysOf[member.inner].push_back(member.name);
  std::vector<ReportStructure> inner(model.structures.begin(), model.structures.end() - 1);
  std::stable_sort(inner.begin(), inner.end(),
                   [&](const ReportStructure& a, const ReportStructure& b) { return keysOf[a.name] < keysOf[b.name]; });
  std::string text = std::string("| key") + kHead + rowsOf(model.structures.back());
  for (const ReportStructure& structure : inner)
    text += fmt::format("\n{}\n\n| key of `{}`{}{}", structure.comment, joined(keysOf[structure.name], "`, `"), kHead,
                        rowsOf(structure));
  const auto named = [&](const char* name) {
    return *std::find_if(model.enumerations.begin(), model.enumerations.end(),
                         [&](const ReportEnumeration& row) { return row.name == name; });
  };
  text += fmt::format("\nStages, in their order: `{}`.\n\n| code of a warning | meaning |\n|---|---|\n",
                      joined(named("Stage").names, "`, `"));
  const ReportEnumeration codes = named("WarningCode");
  for (size_t i = 0; i < codes.names.size(); ++i)
    text += fmt::format("| `{}` | {} |\n", codes.names[i], codes.comments[i]);
  return text;
}

std::string fieldTable() {
  constexpr std::array kTypes{"float32", "uint8", "uint32"};
  std::string text = "| field | type | unit | needs | meaning |\n|---|---|---|---|---|\n";
  for (const FieldRow& row : fieldRows()) {
    const std::string count = row.componentCount == 1 ? "" : fmt::format("{} ", row.componentCount);
    text += fmt::format("| `{}` | {}{} | {} | {} | {} |\n", row.name, count, kTypes[static_cast<size_t>(row.type)],
                        *row.unit == 0 ? "-" : "the mesh's",
                        row.needs == nullptr ? "-" : "`" + withSpelledOptions(row.needs, OptionSpelling::Flag) + "`",
                        row.meaning);
  }
  return text;
}

/// Replaces the text between "<!-- what: ... -->" and "<!-- end of what -->".
std::string replacedBetween(std::string page, const std::string& what, const std::string& text) {
  const size_t mark = page.find("<!-- " + what + ": "), begin = page.find('\n', mark) + 1,
               end = page.find("<!-- end of " + what + " -->");
  ASDFVK_CHECK(mark != page.npos && begin <= end && end != page.npos);
  return page.replace(begin, end - begin, text);
}

}  // namespace

std::string formatPage(const std::string& page, const ReportModel& model) {
  return replacedBetween(replacedBetween(page, "fields", fieldTable()), "keys", keyTables(model));
}

}  // namespace asdfvk
