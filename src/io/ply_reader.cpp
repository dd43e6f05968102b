// PLY 1.0 (Turk 1994): a header (ply_header.h), then the rows of its elements, in ASCII or in binary of either byte
// order (ply_source.h). A mesh needs the element `vertex` with x, y, z of any numeric type, and at least one of the
// elements `face` (with the list vertex_indices or vertex_index) and `tristrips`. Elements may be in any order. The
// reader ignores all other elements and properties. In ASCII each row begins on a new line. Lines of the header that
// the format does not define, and padding after the last row, are ignored and reported.
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "core/text.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/ply_header.h"
#include "io/ply_source.h"
#include "io/ply_writer.h"
#include "mesh/input_faces.h"

namespace asdfvk {
namespace {

/// Converts the vertex indices of a strip to triangles: each index after the second forms a triangle with its two
/// predecessors. Every second triangle is reversed, so that all triangles have the winding of the first. Triangles with
/// a repeated vertex only connect strips and are not faces.
class TriangleStrip {
 public:
  explicit TriangleStrip(InputFaces& faces) : faces_(faces) {}

  /// Makes the next index begin a new strip.
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

/// Reads the rows of all elements. Before memory is allocated, the count of an element is compared with the rest of the
/// file.
template <typename Source>
class PlyBody {
 public:
  PlyBody(std::span<const char> bytes, const PlyHeader& header) : header_(header), source_(bytes, header) {}

  Mesh read() {
    mesh_.skipped = header_.skipped;
    for (const PlyElement& element : header_.elements) readElement(element);
    if (const uint64_t size = source_.requireEnd(); size > 0)
      mesh_.skipped.push_back(counted(size, "byte") + " after the last row");
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
    if (element.role == PlyRole::Other && element.count > 0)
      mesh_.skipped.push_back(fmt::format("{} of element {}", counted(element.count, "row"), quoted(element.name)));
    uint64_t row = 0;
    if (element.role == PlyRole::Vertices) {
      mesh_.vertices.resize(element.count);
      row = source_.takePoints(element, mesh_.vertices);
    } else if (element.role == PlyRole::Faces) {
      std::vector<Face> triangles;
      row = source_.takeTriangles(element, header_.vertexCount, triangles);
      faces_.addTriangles(std::move(triangles));
      faces_.reserve(element.count - row);
    }
    for (; row < element.count; ++row) readRow(element, row);
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

  /// Reads a vertex index, or kRestart for -1 where a restart is allowed.
  uint32_t readIndex(PlyType type, bool allowsRestart) {
    const int64_t index = source_.integer(type, "a vertex index");
    if (allowsRestart && index == -1) return kRestart;
    if (index < 0 || static_cast<uint64_t>(index) >= header_.vertexCount)
      source_.fail(fmt::format("vertex index {} is out of range; the mesh has {}", index,
                               counted(header_.vertexCount, "vertex", "vertices")));
    return static_cast<uint32_t>(index);
  }

  static constexpr uint32_t kRestart = 0xffffffff;  ///< Above every index, because a mesh has fewer vertices.

  const PlyHeader& header_;
  Source source_;
  Mesh mesh_;
  InputFaces faces_;
  std::vector<uint32_t> corners_;
};

Match detectPly(std::span<const char> bytes) { return firstWord(bytes) == "ply" ? Match::Certain : Match::None; }

Mesh parsePly(const MeshSource& source) {
  const std::span<const char> bytes = source.bytes;
  constexpr bool kIsHostLittle = std::endian::native == std::endian::little;
  const PlyHeader header = parsePlyHeader(bytes);
  if (header.encoding == PlyEncoding::Ascii) return PlyBody<PlyAsciiSource>(bytes, header).read();
  if ((header.encoding == PlyEncoding::BinaryLittleEndian) == kIsHostLittle)
    return PlyBody<PlyBinarySource<false>>(bytes, header).read();
  return PlyBody<PlyBinarySource<true>>(bytes, header).read();
}

}  // namespace

extern const FileFormat kPlyFormat{.name = "ply",
                                   .extensions = {"ply"},
                                   .detect = detectPly,
                                   .parseMesh = parsePly,
                                   .write = writePly,
                                   .hasText = true,
                                   .coloursByChoice = true};

}  // namespace asdfvk
