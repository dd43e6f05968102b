// PLY: vertices with their fields, then faces with the list `uchar int vertex_indices` (`int int` above 255 corners)
// and their fields. The main field is `float quality`; the colour of the shown field is `uchar red green blue alpha`.
// The other fields follow by name as float, uchar or uint.
#include "io/ply_writer.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <string>
#include <type_traits>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "core/parallel.h"
#include "core/text.h"
#include "io/field_columns.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/result_colours.h"
#include "io/result_view.h"
#include "io/row_blocks.h"

namespace asdfvk {
namespace {

/// Columns of an element: the main field as `quality`, the colours of the shown field, the other fields by name.
class ElementFields {
 public:
  ElementFields(const ResultView& result, FieldLocation location, std::initializer_list<std::string_view> reservedNames)
      : main_(result.mainField(location)), columns_(columnsOf(result.fields(), location, main_, reservedNames)) {
    const Field* const shown = result.shownField();
    const bool isVertex = location == FieldLocation::PerVertex;
    const Field* own = nullptr;
    for (const Field& field : result.fields())
      if (shown != nullptr && field.name == shown->name && field.location == location) own = &field;
    if (own != nullptr)
      colours_ = coloursOf(*own);
    else if (main_ != nullptr)
      colours_ = coloursOf(*main_);
    else if (shown != nullptr && isVertex && result.coloursVertices())
      colours_ = vertexColoursOf(result, *shown);
  }

  /// Writes nothing without a main field.
  void writeComment(AtomicFile& file, std::string_view quality) const {
    if (main_ != nullptr)
      file.write(fmt::format("comment asdf-vk: {} is {}{}, 0 (and grey) where there is no value\n", quality,
                             main_->name, main_->label.empty() ? "" : fmt::format(" ({})", printable(main_->label))));
  }

  void writeProperties(AtomicFile& file) const {
    constexpr std::array<std::string_view, 3> kPlyTypes{"float", "uchar", "uint"};
    if (main_ != nullptr) file.write("property float quality\n");
    if (!colours_.empty())
      file.write("property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n");
    for (const FieldColumn& column : columns_)
      file.write(fmt::format("property {} {}\n", kPlyTypes[column.field->values.index()], column.name));
  }

  /// Calls put(number) for each column.
  template <typename Put>
  void putRow(uint64_t item, const Put& put) const {
    if (main_ != nullptr) put(withoutNan((*main_->reals())[item]));
    if (!colours_.empty())
      for (const uint8_t channel : colours_[item]) put(channel);
    for (const FieldColumn& column : columns_)
      column.putEntry(item, [&](auto entry) {
        static_assert(sizeof(withoutNan(entry)) <= sizeof(float));
        put(withoutNan(entry));
      });
  }

  /// Upper limit of the number of bytes of putRow() in a binary file.
  [[nodiscard]] size_t maxRowSize() const { return sizeof(float) + sizeof(Rgba) + columns_.size() * sizeof(float); }

 private:
  const Field* main_;  ///< Null if the element has no main field.
  std::vector<FieldColumn> columns_;
  std::vector<Rgba> colours_;  ///< Empty if the element has no colours.
};

class PlyWriter {
 public:
  PlyWriter(AtomicFile& file, const ResultView& result)
      : file_(file),
        result_(result),
        vertexFields_(result, FieldLocation::PerVertex, {"x", "y", "z", "quality", "red", "green", "blue", "alpha"}),
        faceFields_(result, FieldLocation::PerFace,
                    {"vertex_indices", "vertex_index", "quality", "red", "green", "blue", "alpha"}) {
    hasByteLengths_ = maxInParallel<size_t>(result.faceCount(), [&](uint32_t face) {
                        return result.cornersOf(face).size();
                      }) <= std::numeric_limits<uint8_t>::max();
  }

  void write() {
    const bool isFloat = result_.hasFloatVertices();
    writeHeader(isFloat ? "float" : "double");
    isFloat ? writeVertices<float>() : writeVertices<double>();
    hasByteLengths_ ? writeFaces<uint8_t>() : writeFaces<int32_t>();
  }

 private:
  void writeHeader(std::string_view scalar) {
    file_.write(fmt::format("ply\nformat {} 1.0\n", result_.isAscii() ? "ascii" : "binary_little_endian"));
    faceFields_.writeComment(file_, "quality");
    vertexFields_.writeComment(file_, "quality of vertices");
    file_.write(fmt::format("element vertex {}\n", result_.vertexCount()));
    for (const char axis : {'x', 'y', 'z'}) file_.write(fmt::format("property {} {}\n", scalar, axis));
    vertexFields_.writeProperties(file_);
    file_.write(fmt::format("element face {}\nproperty list {} int vertex_indices\n", result_.faceCount(),
                            hasByteLengths_ ? "uchar" : "int"));
    faceFields_.writeProperties(file_);
    file_.write("end_header\n");
  }

  template <typename T>
  void writeVertices() {
    writeRows(file_, result_.vertexCount(), [&](ByteBuffer& to, uint64_t vertex) {
      const std::array<T, 3> point = result_.pointAt<T>(vertex);
      putRow(to, sizeof(point) + vertexFields_.maxRowSize(), [&](const auto& put) {
        for (const T coordinate : point) put(coordinate);
        vertexFields_.putRow(vertex, put);
      });
    });
  }

  template <typename Length>
  void writeFaces() {
    writeRows(file_, result_.faceCount(), [&](ByteBuffer& to, uint64_t face) {
      const std::span<const uint32_t> corners = result_.cornersOf(face);
      putRow(to, sizeof(Length) + corners.size_bytes() + faceFields_.maxRowSize(), [&](const auto& put) {
        put(static_cast<Length>(corners.size()));
        for (const uint32_t corner : corners) put(corner);
        faceFields_.putRow(face, put);
      });
    });
  }

  /// Appends the numbers for which putAll(put) calls put(number), as bytes or as words separated by blanks. maxSize:
  /// upper limit of the number of bytes.
  template <typename PutAll>
  void putRow(ByteBuffer& to, size_t maxSize, const PutAll& putAll) const {
    if (result_.isAscii()) {
      bool isFirst = true;
      putAll([&](auto number) {
        if (!isFirst) to.put(' ');
        to.putNumber(number);
        isFirst = false;
      });
      to.put('\n');
    } else {
      char* const row = to.reserve(maxSize);
      char* next = row;
      putAll([&](auto number) {
        std::memcpy(next, &number, sizeof(number));
        next += sizeof(number);
      });
      to.advance(static_cast<size_t>(next - row));
    }
  }

  AtomicFile& file_;
  const ResultView& result_;
  ElementFields vertexFields_, faceFields_;
  bool hasByteLengths_ = true;
};

}  // namespace

void writePly(AtomicFile& file, const ResultView& result) {
  if (result.vertexCount() > uint64_t{std::numeric_limits<int32_t>::max()})
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("the mesh has {}; a PLY index of type int allows {}",
                            counted(result.vertexCount(), "vertex", "vertices"), std::numeric_limits<int32_t>::max()));
  PlyWriter(file, result).write();
}

}  // namespace asdfvk
