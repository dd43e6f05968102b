// PLY 1.0 (Turk 1994): a header (ply_header.h), then the rows of its elements, ASCII or binary of either byte order
// (ply_source.h). A mesh needs the element `vertex` with x, y, z of any numeric type, and the element `face` with the
// list vertex_indices or vertex_index, or `tristrips`, or both; in any order. The reader ignores all other
// elements and properties. In ASCII each row begins on a new line.
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

#include "core/parallel.h"
#include "core/text.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/ply_header.h"
#include "io/ply_source.h"
#include "mesh/input_faces.h"

namespace asdfvk {
namespace {

/// Converts vertex indices of a strip to triangles: each index after the second forms one with its two predecessors,
/// every other one reversed, so that all have the winding of the first. Triangles with a repeated vertex only connect
/// strips and are no faces.
class TriangleStrip {
 public:
  explicit TriangleStrip(InputFaces& faces) : faces_(faces) {}

  /// The next index begins a new strip.
  void restart() { length_ = 0; }

  void add(uint32_t vertex) {
    if (length_ >= 2 && first_ != second_ && second_ != vertex && vertex != first_) {
      const bool isReversed = length_ % 2 == 1;
      const std::array<uint32_t, 3> corners = {isReversed ? second_ : first_, isReversed ? first_ : second_, vertex};
      faces_.add(corners);
    }
    first_ = second_;
    second_ = vertex;
    ++length_;
  }

 private:
  InputFaces& faces_;
  uint64_t length_ = 0;
  uint32_t first_ = 0, second_ = 0;  ///< The last two indices.
};

/// Calls decode(first, end) for parts of [0, count), in parallel where there are several.
template <typename Decode>
void forRows(uint64_t count, const Decode& decode) {
  constexpr uint64_t kRowsPerTask = 1 << 15;
  if (count <= kRowsPerTask) return decode(uint64_t{0}, count);
  forEachRange(count, kRowsPerTask, decode);
}

/// Reads the rows of all elements. Allocates memory for an element only after a check of its count against the rest of
/// the file.
template <typename Source>
class PlyBody {
 public:
  PlyBody(std::span<const char> bytes, const PlyHeader& header) : header_(header), source_(bytes, header) {}

  Mesh read() {
    for (const PlyElement& element : header_.elements) readElement(element);
    source_.requireEnd();
    faces_.moveTo(mesh_);
    return std::move(mesh_);
  }

 private:
  void readElement(const PlyElement& element) {
    const uint64_t minRowSize = element.minRowSize(header_.encoding);
    if (minRowSize == 0) return;
    if (!source_.canHoldRows(element.count, minRowSize))
      source_.fail(
          fmt::format("{} of element {} do not fit into the remaining {}; the file is truncated or the count "
                      "is wrong",
                      counted(element.count, "row"), quoted(element.name), counted(source_.remaining(), "byte")));
    if (element.role == PlyRole::Vertices) mesh_.vertices.resize(element.count);
    if constexpr (Source::kIsBinary)
      if (readUniformRows(element, minRowSize)) return;
    if (element.role == PlyRole::Faces) faces_.reserve(element.count);
    for (uint64_t row = 0; row < element.count; ++row) readRow(element, row);
  }

  /// Reads the rows of a binary element in parallel where all have one size: without lists, or faces that are all
  /// triangles and have no other list. Otherwise reads nothing and returns false.
  bool readUniformRows(const PlyElement& element, uint64_t minRowSize) {
    size_t listCount = 0;
    for (const PlyProperty& property : element.properties) listCount += property.list ? 1 : 0;
    if (element.role == PlyRole::Faces && listCount == 1) return readTriangles(element, minRowSize);
    if (listCount > 0) return false;
    if (element.role == PlyRole::Vertices) readUniformVertices(element, minRowSize);
    source_.skipBytes(element.count * minRowSize);
    return true;
  }

  void readUniformVertices(const PlyElement& element, uint64_t rowSize) {
    std::array<uint64_t, 3> offsets{};
    std::array<PlyType, 3> types{};
    for (size_t axis = 0; axis < 3; ++axis) {
      offsets[axis] = offsetOf(element, element.coordinates[axis]);
      types[axis] = element.properties[element.coordinates[axis]].type;
    }
    forRows(element.count, [&](uint64_t first, uint64_t end) {
      for (uint64_t row = first; row < end; ++row)
        for (size_t axis = 0; axis < 3; ++axis)
          mesh_.vertices[row][axis] = source_.template load<double>(row * rowSize + offsets[axis], types[axis]);
    });
  }

  /// False where a face is not a triangle or has an index out of range; the rows are then read one by one, which finds
  /// the place of an error.
  bool readTriangles(const PlyElement& element, uint64_t minRowSize) {
    const PlyProperty& indices = element.properties[element.indices];
    const uint64_t indexSize = sizeOf(indices.type), lengthSize = sizeOf(*indices.list);
    const uint64_t rowSize = minRowSize + 3 * indexSize;
    if (!source_.canHoldRows(element.count, rowSize)) return false;
    const uint64_t offset = offsetOf(element, element.indices);
    std::vector<Face> faces(element.count);
    std::atomic<bool> isValid = true;
    forRows(element.count, [&](uint64_t first, uint64_t end) {
      for (uint64_t row = first; row < end && isValid.load(std::memory_order_relaxed); ++row) {
        const uint64_t list = row * rowSize + offset;
        bool isRowValid = source_.template load<int64_t>(list, *indices.list) == 3;
        for (size_t c = 0; c < 3; ++c) {
          const auto index = source_.template load<int64_t>(list + lengthSize + c * indexSize, indices.type);
          isRowValid = isRowValid && static_cast<uint64_t>(index) < header_.vertexCount;
          faces[row][c] = static_cast<uint32_t>(index);
        }
        if (!isRowValid) isValid = false;
      }
    });
    if (!isValid) return false;
    faces_.addTriangles(std::move(faces));
    source_.skipBytes(element.count * rowSize);
    return true;
  }

  /// Byte of a property in the row of its element. Precondition: no list precedes it.
  [[nodiscard]] static uint64_t offsetOf(const PlyElement& element, size_t property) {
    uint64_t offset = 0;
    for (size_t i = 0; i < property; ++i) offset += sizeOf(element.properties[i].type);
    return offset;
  }

  void readRow(const PlyElement& element, uint64_t row) {
    for (size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.list) {
        readList(element, i);
        continue;
      }
      const double value = source_.number(property.type, property.name);
      for (size_t axis = 0; axis < 3; ++axis)
        if (i == element.coordinates[axis]) mesh_.vertices[row][axis] = value;
    }
    source_.endRow(element, row);
  }

  void readList(const PlyElement& element, size_t propertyIndex) {
    const PlyProperty& property = element.properties[propertyIndex];
    const int64_t signedLength = source_.integer(*property.list, "the length of a list");
    const auto length = static_cast<uint64_t>(signedLength);
    if (signedLength < 0 || !source_.canHoldItems(length, property.type))
      source_.fail(
          fmt::format("a list of length {} does not fit into the remaining {}; the file is truncated or the "
                      "length is wrong",
                      signedLength, counted(source_.remaining(), "byte")));
    if (propertyIndex != element.indices) {
      source_.skip(length, property.type, property.name);
    } else if (element.role == PlyRole::Faces) {
      corners_.clear();
      for (uint64_t i = 0; i < length; ++i) corners_.push_back(readIndex(property.type, false));
      faces_.add(corners_);
    } else {
      TriangleStrip strip(faces_);
      for (uint64_t i = 0; i < length; ++i) {
        const uint32_t index = readIndex(property.type, true);
        index == kRestart ? strip.restart() : strip.add(index);
      }
    }
  }

  /// A vertex index, or -1 as kRestart where that is allowed.
  uint32_t readIndex(PlyType type, bool allowsRestart) {
    const int64_t index = source_.integer(type, "a vertex index");
    if (allowsRestart && index == -1) return kRestart;
    if (index < 0 || static_cast<uint64_t>(index) >= header_.vertexCount)
      source_.fail(fmt::format("vertex index {} is out of range; the mesh has {}", index,
                               counted(header_.vertexCount, "vertex", "vertices")));
    return static_cast<uint32_t>(index);
  }

  static constexpr uint32_t kRestart = 0xffffffff;  ///< Above every index: a mesh has fewer vertices.

  const PlyHeader& header_;
  Source source_;
  Mesh mesh_;
  InputFaces faces_;
  std::vector<uint32_t> corners_;
};

Match detectPly(std::span<const char> bytes) { return firstWord(bytes) == "ply" ? Match::Certain : Match::None; }

Mesh parsePly(std::span<const char> bytes) {
  constexpr bool kIsHostLittle = std::endian::native == std::endian::little;
  const PlyHeader header = parsePlyHeader(bytes);
  if (header.encoding == PlyEncoding::Ascii) return PlyBody<PlyAsciiSource>(bytes, header).read();
  if ((header.encoding == PlyEncoding::BinaryLittleEndian) == kIsHostLittle)
    return PlyBody<PlyBinarySource<false>>(bytes, header).read();
  return PlyBody<PlyBinarySource<true>>(bytes, header).read();
}

}  // namespace

extern const FileFormat kPlyFormat{
    .name = "ply", .extensions = {"ply"}, .detect = detectPly, .parseMesh = parsePly, .write = writePly};

}  // namespace asdfvk
