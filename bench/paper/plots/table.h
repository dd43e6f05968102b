#pragma once

#include <string>
#include <vector>

namespace asdfvk::bench {

/// A word, or a number with the digits that a reader wants.
struct Cell {
  std::string text;   ///< As it is shown; empty for nothing.
  std::string exact;  ///< As a program reads it.
  bool isNumber = false;

  static Cell word(std::string text) { return {text, text, false}; }
  /// NaN leaves the cell empty.
  static Cell number(double value, int decimals);
  static Cell count(uint64_t value);
};

struct Column {
  std::string group;  ///< Neighbouring columns of one group have a heading in common; may be empty.
  std::string name;
  bool isQuoted = false;  ///< Another publication's numbers.
};

struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  ///< A cell per column.
};

/// RFC 4180 with LF: a heading line ("group: name"), then the rows with their exact numbers.
[[nodiscard]] std::string toCsv(const Table& table);

/// The <table> element.
[[nodiscard]] std::string toHtml(const Table& table);

}  // namespace asdfvk::bench
