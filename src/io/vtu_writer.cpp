// VTK's unstructured grid in XML with inline base64: PointData and CellData of Float32, UInt8 and UInt32.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/atomic_file.h"
#include "core/base64_stream.h"
#include "io/field_columns.h"
#include "io/formats.h"
#include "io/result_view.h"

namespace asdfvk {
namespace {

template <typename T>
constexpr std::string_view vtkTypeName() {
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, uint8_t>) return "UInt8";
  if constexpr (std::is_same_v<T, uint32_t>) return "UInt32";
}

/// The VTK cell type of a face: empty cell, vertex, line, triangle or polygon.
uint8_t cellTypeOf(size_t cornerCount) {
  constexpr std::array<uint8_t, 4> kCellTypes{0, 1, 3, 5};
  return cornerCount < kCellTypes.size() ? kCellTypes[cornerCount] : uint8_t{7};
}

class VtuWriter {
 public:
  VtuWriter(AtomicFile& file, const ResultView& result) : file_(file), result_(result) {
    const uint64_t cornerCount = result.cornerCount(), vertexCount = result.vertexCount();
    hasWideIndices_ = std::max(cornerCount, vertexCount) > uint64_t{std::numeric_limits<int32_t>::max()};
    hasFloatVertices_ = result.hasFloatVertices();
    uint64_t maxByteCount =
        std::max({cornerCount * (hasWideIndices_ ? 8 : 4), result.faceCount() * (hasWideIndices_ ? 8 : 4),
                  3 * vertexCount * (hasFloatVertices_ ? 4 : 8)});
    for (const Field& field : result.fields()) maxByteCount = std::max(maxByteCount, uint64_t{4} * field.size());
    hasWideSizes_ = maxByteCount > std::numeric_limits<uint32_t>::max();
  }

  void write() {
    file_.write(fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"{}\">\n"
        "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
        hasWideSizes_ ? "UInt64" : "UInt32", result_.vertexCount(), result_.faceCount()));
    hasFloatVertices_ ? writePoints<float>() : writePoints<double>();
    file_.write("</Points>\n<Cells>\n");
    hasWideIndices_ ? writeCells<int64_t>() : writeCells<int32_t>();
    file_.write("</Cells>\n");
    writeFields("PointData", FieldLocation::PerVertex);
    writeFields("CellData", FieldLocation::PerFace);
    file_.write("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  }

 private:
  /// emit(put) calls put(entry) for each of the `count` entries, in order.
  template <typename T, typename Emit>
  void writeArray(const std::string& attributes, uint64_t count, Emit emit) {
    file_.write(fmt::format("<DataArray type=\"{}\" {} format=\"binary\">", vtkTypeName<T>(), attributes));
    Base64Stream stream(file_);
    const uint64_t byteCount = count * sizeof(T);
    hasWideSizes_ ? stream.put(byteCount) : stream.put(static_cast<uint32_t>(byteCount));
    emit([&](T value) { stream.put(value); });
    stream.finish();
    file_.write("</DataArray>\n");
  }

  template <typename T>
  void writePoints() {
    writeArray<T>("Name=\"Points\" NumberOfComponents=\"3\"", 3 * result_.vertexCount(), [&](auto put) {
      for (uint64_t vertex = 0; vertex < result_.vertexCount(); ++vertex)
        for (const T coordinate : result_.pointAt<T>(vertex)) put(coordinate);
    });
  }

  template <typename T>
  void writeCells() {
    const uint64_t cellCount = result_.faceCount();
    writeArray<T>("Name=\"connectivity\"", result_.cornerCount(), [&](auto put) {
      for (uint64_t i = 0; i < cellCount; ++i)
        for (const uint32_t corner : result_.cornersOf(i)) put(static_cast<T>(corner));
    });
    writeArray<T>("Name=\"offsets\"", cellCount, [&](auto put) {
      uint64_t end = 0;
      for (uint64_t i = 0; i < cellCount; ++i) put(static_cast<T>(end += result_.cornersOf(i).size()));
    });
    writeArray<uint8_t>("Name=\"types\"", cellCount, [&](auto put) {
      for (uint64_t i = 0; i < cellCount; ++i) put(cellTypeOf(result_.cornersOf(i).size()));
    });
  }

  /// Writes nothing if no field has that location.
  void writeFields(std::string_view element, FieldLocation location) {
    const auto isHere = [&](const Field& field) { return field.location == location; };
    if (std::none_of(result_.fields().begin(), result_.fields().end(), isHere)) return;
    const Field* const main = result_.mainField(location);
    file_.write(main == nullptr ? fmt::format("<{}>\n", element)
                                : fmt::format("<{} Scalars=\"{}\">\n", element, main->name));
    for (const Field& field : result_.fields())
      if (isHere(field)) writeField(field);
    file_.write(fmt::format("</{}>\n", element));
  }

  void writeField(const Field& field) {
    std::string attributes = fmt::format("Name=\"{}\"", field.name);
    if (field.componentCount != 1) attributes += fmt::format(" NumberOfComponents=\"{}\"", field.componentCount);
    std::visit(
        [&](const auto& entries) {
          writeArray<decltype(withoutNan(entries[0]))>(attributes, entries.size(), [&](auto put) {
            for (const auto entry : entries) put(withoutNan(entry));
          });
        },
        field.values);
  }

  AtomicFile& file_;
  const ResultView& result_;
  bool hasWideIndices_ = false;  ///< Indices are Int64.
  bool hasWideSizes_ = false;    ///< Byte counts of arrays are UInt64.
  bool hasFloatVertices_ = false;
};

}  // namespace

extern const FileFormat kVtuFormat{
    .name = "vtu", .extensions = {"vtu"}, .write = [](AtomicFile& file, const ResultView& result) {
      VtuWriter(file, result).write();
    }};

}  // namespace asdfvk
