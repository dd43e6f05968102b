// Comma-separated values: a header line, then a row per face or per vertex, numbered from 0 in the first column `face`
// or `vertex`. Numbers have the shortest text that reads back the same; all fields that are read are real.
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "core/text.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/stored_fields.h"

namespace asdfvk {
namespace {

void writeRows(AtomicFile& file, std::string_view keyName, uint64_t rowCount, std::span<const FieldColumn> columns) {
  file.write(keyName);
  for (const FieldColumn& column : columns) file.write("," + column.name);
  file.put('\n');
  for (uint64_t row = 0; row < rowCount; ++row) {
    char* const key = file.reserve(kNumberTextSize);
    file.advance(static_cast<size_t>(appendNumber(key, row) - key));
    for (const FieldColumn& column : columns) {
      char* const cell = file.reserve(kNumberTextSize + 1);
      *cell = ',';
      char* end = cell + 1;
      column.putEntry(row, [&]<typename T>(T entry) {
        if constexpr (sizeof(T) == 1) {
          end = appendNumber(end, static_cast<unsigned>(entry));
        } else {
          end = appendNumber(end, entry);
        }
      });
      file.advance(static_cast<size_t>(end - cell));
    }
    file.put('\n');
  }
}

/// The lines of a text, which must all end with a line break, and their cells.
class CsvScanner {
 public:
  explicit CsvScanner(std::span<const char> bytes) : rest_(bytes.data(), bytes.size()) {}

  /// False at the end of the text.
  bool nextLine() {
    if (rest_.empty()) return false;
    ++line_;
    const size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("the last line has no line break; the file is truncated");
    cells_ = rest_.substr(0, end);
    if (cells_.ends_with('\r')) cells_.remove_suffix(1);
    rest_.remove_prefix(end + 1);
    isLineDone_ = false;
    return true;
  }
  [[nodiscard]] bool hasCell() const { return !isLineDone_; }
  [[nodiscard]] std::string_view nextCell() {
    if (isLineDone_) fail("the row has fewer cells than the header");
    const size_t end = cells_.find(',');
    const std::string_view cell = cells_.substr(0, end);
    isLineDone_ = end == std::string_view::npos;
    if (!isLineDone_) cells_.remove_prefix(end + 1);
    return cell;
  }
  template <typename T>
  [[nodiscard]] T nextNumber(std::string_view expected) {
    const std::string_view cell = nextCell();
    T number{};
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (error != std::errc() || end != cell.data() + cell.size())
      fail(fmt::format("expected {}, found {}", expected, quoted(cell)));
    return number;
  }
  /// Cells left on the line.
  [[nodiscard]] size_t cellCount() const {
    return isLineDone_ ? 0 : 1 + static_cast<size_t>(std::count(cells_.begin(), cells_.end(), ','));
  }
  [[noreturn]] void fail(std::string_view reason) const { failAtLine(line_, reason); }

 private:
  std::string_view rest_, cells_;  ///< Behind the line, and of the line.
  uint64_t line_ = 0;
  bool isLineDone_ = true;
};

void writeCsv(AtomicFile& file, const ResultView& result) {
  const std::vector<FieldColumn> faceColumns = columnsOf(result.fields(), FieldLocation::PerFace, nullptr, {"face"});
  const std::vector<FieldColumn> vertexColumns =
      columnsOf(result.fields(), FieldLocation::PerVertex, nullptr, {"vertex"});
  if (vertexColumns.empty()) return writeRows(file, "face", result.faceCount(), faceColumns);
  if (!faceColumns.empty())
    throw Error(ErrorCode::OptionConflict,
                fmt::format("field {} is per vertex and field {} per face; a .csv has rows of one kind, so write two "
                            "files, or a .npz",
                            vertexColumns.front().field->name, faceColumns.front().field->name));
  writeRows(file, "vertex", result.vertexCount(), vertexColumns);
}

Match detectCsv(std::span<const char> bytes) {
  const std::string_view text(bytes.data(), bytes.size());
  const std::string_view name = text.substr(0, text.find_first_of(",\r\n"));
  return name == "face" || name == "vertex" ? Match::Possible : Match::None;
}

std::vector<Field> parseCsvFields(std::span<const char> bytes) {
  CsvScanner scanner(bytes);
  if (!scanner.nextLine()) failInput("is empty");
  const std::string_view key = scanner.nextCell();
  if (key != "face" && key != "vertex") scanner.fail("the first column is neither 'face' nor 'vertex'");
  std::vector<Field> columns;
  columns.reserve(scanner.cellCount());
  while (scanner.hasCell()) {
    Field& column = columns.emplace_back();
    column.name = scanner.nextCell();
    column.location = key == "face" ? FieldLocation::PerFace : FieldLocation::PerVertex;
  }
  requireReadableNames(columns);
  for (uint64_t row = 0; scanner.nextLine(); ++row) {
    const auto number = scanner.nextNumber<uint64_t>("the number of the row");
    if (number != row) scanner.fail(fmt::format("expected row {}, found row {}", row, number));
    for (Field& column : columns) std::get<0>(column.values).push_back(scanner.nextNumber<double>("a number"));
    if (scanner.hasCell()) scanner.fail("the row has more cells than the header");
  }
  return joinColumns(std::move(columns));
}

}  // namespace

extern const FileFormat kCsvFormat{.name = "csv",
                                   .extensions = {"csv"},
                                   .detect = detectCsv,
                                   .parseFields = parseCsvFields,
                                   .write = writeCsv,
                                   .writesDoubles = true};

}  // namespace asdfvk
