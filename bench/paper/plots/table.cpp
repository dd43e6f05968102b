#include "paper/plots/table.h"
#include "core/text.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/report_text.h"
#include "core/check.h"
#include "paper/plots/markup.h"

namespace asdfvk::bench {
namespace {

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

/// The row of headings that groups of columns have in common; empty where there is no group.
std::string groupRow(const std::vector<Column>& columns) {
  std::string row;
  bool hasGroup = false;
  for (size_t first = 0; first < columns.size();) {
    size_t last = first;
    while (last < columns.size() && columns[last].group == columns[first].group) ++last;
    hasGroup |= !columns[first].group.empty();
    row += fmt::format("<th colspan=\"{}\"{}>{}</th>", last - first, columns[first].group.empty() ? "" : " class=group",
                       escapeMarkup(columns[first].group));
    first = last;
  }
  return hasGroup ? "<tr>" + row + "</tr>\n" : "";
}

/// Of the cells of a column, for the page's style.
std::string classOf(const std::vector<Column>& columns, size_t index, bool isNumber) {
  std::string names;
  if (isNumber) names += " number";
  if (columns[index].isQuoted) names += " quoted";
  if (index > 0 && columns[index].group != columns[index - 1].group) names += " first";
  return names.empty() ? "" : fmt::format(" class=\"{}\"", names.substr(1));
}

}  // namespace

Cell Cell::number(double value, int decimals) {
  if (std::isnan(value)) return {"", "", true};
  return {fmt::format("{:.{}f}", value, decimals), fmt::format("{}", value), true};
}

Cell Cell::count(uint64_t value) { return {groupDigits(value), std::to_string(value), true}; }

std::string toCsv(const Table& table) {
  std::string text;
  const auto endLine = [&text] { text.back() = '\n'; };
  for (const Column& column : table.columns)
    text += csvField(column.group.empty() ? column.name : column.group + ": " + column.name) + ',';
  endLine();
  for (const std::vector<Cell>& row : table.rows) {
    ASDFVK_CHECK_OP(row.size(), ==, table.columns.size());
    for (const Cell& cell : row) text += csvField(cell.exact) + ',';
    endLine();
  }
  return text;
}

std::string toHtml(const Table& table) {
  std::string text = "<table>\n<thead>\n" + groupRow(table.columns) + "<tr>";
  for (size_t i = 0; i < table.columns.size(); ++i) {
    const bool isNumber = !table.rows.empty() && table.rows.front()[i].isNumber;
    text += fmt::format("<th{}>{}</th>", classOf(table.columns, i, isNumber), escapeMarkup(table.columns[i].name));
  }
  text += "</tr>\n</thead>\n<tbody>\n";
  for (const std::vector<Cell>& row : table.rows) {
    text += "<tr>";
    for (size_t i = 0; i < row.size(); ++i)
      text += fmt::format("<td{}>{}</td>", classOf(table.columns, i, row[i].isNumber), escapeMarkup(row[i].text));
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

}  // namespace asdfvk::bench
