// Comma-separated values: a header line, then a row per face or per vertex. The first column, `face` or `vertex`,
// numbers the rows from 0. A number is written as the shortest text that reads back as the same number.
#include <fmt/core.h>

#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "io/field_columns.h"
#include "io/formats.h"
#include "io/result_view.h"
#include "io/row_blocks.h"

namespace asdfvk {
namespace {

void writeTable(AtomicFile& file, std::string_view keyName, uint64_t rowCount, std::span<const FieldColumn> columns) {
  file.write(keyName);
  for (const FieldColumn& column : columns) file.write("," + column.name);
  file.put('\n');
  writeRows(file, rowCount, [&](ByteBuffer& to, uint64_t row) {
    to.putNumber(row);
    for (const FieldColumn& column : columns) {
      to.put(',');
      column.putEntry(row, [&](auto entry) { to.putNumber(entry); });
    }
    to.put('\n');
  });
}

void writeCsv(AtomicFile& file, const ResultView& result) {
  const std::vector<FieldColumn> faceColumns = columnsOf(result.fields(), FieldLocation::PerFace, nullptr, {"face"});
  const std::vector<FieldColumn> vertexColumns =
      columnsOf(result.fields(), FieldLocation::PerVertex, nullptr, {"vertex"});
  if (vertexColumns.empty()) return writeTable(file, "face", result.faceCount(), faceColumns);
  if (!faceColumns.empty())
    throw Error(ErrorCode::OptionConflict,
                fmt::format("field {} is per vertex and field {} per face; a .csv has rows of one kind, so write two "
                            "files, or a .npz",
                            vertexColumns.front().field->name, faceColumns.front().field->name));
  writeTable(file, "vertex", result.vertexCount(), vertexColumns);
}

}  // namespace

extern const FileFormat kCsvFormat{
    .name = "csv", .extensions = {"csv"}, .write = writeCsv, .writesDoubles = true, .holdsOneLocation = true};

}  // namespace asdfvk
