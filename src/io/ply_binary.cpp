#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <bit>

#include "core/text.h"
#include "io/input_failure.h"
#include "io/ply_body.h"
#include "io/ply_scalar.h"
#include "io/triangle_strip.h"

namespace asdfvk {
namespace {

constexpr bool kIsHostLittle = std::endian::native == std::endian::little;
constexpr uint64_t kRowsPerTask = 1 << 15;

/// Calls decode(first, end) over [0, count), in parallel where that is worth it.
template <typename Decode>
void forRows(uint64_t count, const Decode& decode) {
  if (count <= kRowsPerTask) return decode(uint64_t{0}, count);
  tbb::parallel_for(tbb::blocked_range<uint64_t>(0, count, kRowsPerTask),
                    [&](const auto& range) { decode(range.begin(), range.end()); });
}

template <bool isSwapped>
class BinaryBody {
 public:
  BinaryBody(std::span<const char> bytes, const PlyHeader& header, PlyTarget& target)
      : header_(header), bytes_(bytes), at_(header.bodyOffset), target_(target) {}

  void read() {
    for (const PlyElement& element : header_.elements) readElement(element);
    if (left() != 0) failAtByte(at_, counted(left(), "byte") + " too many behind the last row");
  }

 private:
  [[nodiscard]] uint64_t left() const { return bytes_.size() - at_; }
  [[nodiscard]] int64_t integerAt(uint64_t offset, PlyType type) const {
    return loadPly<int64_t, isSwapped>(bytes_.data() + offset, type);
  }

  void readElement(const PlyElement& element) {
    const uint64_t minRowSize = element.minRowSize(header_.encoding);
    if (minRowSize == 0) return;
    if (element.count > left() / minRowSize)
      failAtByte(at_, fmt::format("{} of element {} cannot fit into the {} left; the file is cut "
                                  "short or its count is wrong",
                                  counted(element.count, "row"), quoted(element.name), counted(left(), "byte")));
    if (element.role == PlyRole::Vertices) target_.vertices.resize(element.count);
    size_t listCount = 0;
    for (const PlyProperty& property : element.properties) listCount += property.list ? 1 : 0;
    if (listCount == 0) {
      if (element.role == PlyRole::Vertices) readFixedVertices(element, minRowSize);
      at_ += element.count * minRowSize;
    } else if (!(element.role == PlyRole::Faces && listCount == 1 && readTriangles(element, minRowSize))) {
      if (element.role == PlyRole::Faces) target_.faces.reserve(element.count);
      for (uint64_t row = 0; row < element.count; ++row) readRow(element, row);
    }
  }

  void readFixedVertices(const PlyElement& element, uint64_t rowSize) {
    std::array<uint64_t, 3> offsets{};
    std::array<PlyType, 3> types{};
    uint64_t offset = 0;
    for (size_t i = 0; i < element.properties.size(); ++i) {
      for (size_t axis = 0; axis < 3; ++axis) {
        if (element.coordinates[axis] != i) continue;
        offsets[axis] = offset;
        types[axis] = element.properties[i].type;
      }
      offset += sizeOf(element.properties[i].type);
    }
    forRows(element.count, [&](uint64_t first, uint64_t end) {
      const char* row = bytes_.data() + at_ + first * rowSize;
      for (uint64_t i = first; i < end; ++i, row += rowSize)
        for (size_t axis = 0; axis < 3; ++axis)
          target_.vertices[i][axis] = loadPly<double, isSwapped>(row + offsets[axis], types[axis]);
    });
  }

  /// Where all faces are triangles, and no other list stands beside theirs, all rows have one size and can be read in
  /// parallel. False, and nothing read, if that or an index does not hold: row by row is to find out what is wrong.
  bool readTriangles(const PlyElement& element, uint64_t minRowSize) {
    const PlyProperty& indices = element.properties[element.indices];
    const uint64_t indexSize = sizeOf(indices.type), countSize = sizeOf(*indices.list);
    const uint64_t rowSize = minRowSize + 3 * indexSize;
    if (element.count > left() / rowSize) return false;
    uint64_t offset = 0;
    for (size_t i = 0; i < element.indices; ++i) offset += sizeOf(element.properties[i].type);
    std::vector<Face> faces(element.count);
    std::atomic<bool> isGood = true;
    forRows(element.count, [&](uint64_t first, uint64_t end) {
      uint64_t list = at_ + first * rowSize + offset;
      for (uint64_t i = first; i < end && isGood.load(std::memory_order_relaxed); ++i, list += rowSize) {
        bool isRowGood = integerAt(list, *indices.list) == 3;
        for (size_t c = 0; c < 3; ++c) {
          const int64_t index = integerAt(list + countSize + c * indexSize, indices.type);
          isRowGood = isRowGood && static_cast<uint64_t>(index) < header_.vertexCount;
          faces[i][c] = static_cast<uint32_t>(index);
        }
        if (!isRowGood) isGood = false;
      }
    });
    if (!isGood) return false;
    target_.faces.addTriangles(std::move(faces));
    at_ += element.count * rowSize;
    return true;
  }

  void readRow(const PlyElement& element, uint64_t row) {
    for (size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.list) {
        readList(element, i, row);
        continue;
      }
      requireLeft(sizeOf(property.type), element, row);
      for (size_t axis = 0; axis < 3; ++axis)
        if (i == element.coordinates[axis])
          target_.vertices[row][axis] = loadPly<double, isSwapped>(bytes_.data() + at_, property.type);
      at_ += sizeOf(property.type);
    }
  }

  void readList(const PlyElement& element, size_t propertyIndex, uint64_t row) {
    const PlyProperty& property = element.properties[propertyIndex];
    requireLeft(sizeOf(*property.list), element, row);
    const int64_t count = integerAt(at_, *property.list);
    const uint64_t itemSize = sizeOf(property.type);
    if (count < 0 || static_cast<uint64_t>(count) > (left() - sizeOf(*property.list)) / itemSize)
      failAtByte(at_, fmt::format(
                          "row {} of element {} claims a list of length {}, but the file has only {} more; the file is "
                          "cut short or its count is wrong",
                          row, quoted(element.name), count, counted(left() - sizeOf(*property.list), "byte")));
    at_ += sizeOf(*property.list);
    const uint64_t end = at_ + static_cast<uint64_t>(count) * itemSize;
    if (propertyIndex == element.indices && element.role == PlyRole::Faces) {
      corners_.clear();
      for (; at_ < end; at_ += itemSize) corners_.push_back(vertexIndex(integerAt(at_, property.type), row));
      target_.faces.add(corners_);
    } else if (propertyIndex == element.indices) {
      TriangleStrip strip(target_.faces);
      for (; at_ < end; at_ += itemSize) {
        const int64_t index = integerAt(at_, property.type);
        index == -1 ? strip.restart() : strip.add(vertexIndex(index, row));
      }
    }
    at_ = end;
  }

  void requireLeft(uint64_t size, const PlyElement& element, uint64_t row) const {
    if (left() < size)
      failAtByte(at_,
                 fmt::format("the file ends within row {} of element {}; it is cut short", row, quoted(element.name)));
  }

  [[nodiscard]] uint32_t vertexIndex(int64_t index, uint64_t row) const {
    if (index < 0 || static_cast<uint64_t>(index) >= header_.vertexCount)
      failAtByte(at_, fmt::format("vertex index {} in row {} is out of range; the mesh has {}", index, row,
                                  counted(header_.vertexCount, "vertex", "vertices")));
    return static_cast<uint32_t>(index);
  }

  const PlyHeader& header_;
  std::span<const char> bytes_;
  uint64_t at_;  ///< The next byte to read.
  PlyTarget& target_;
  std::vector<uint32_t> corners_;
};

}  // namespace

void readPlyBinary(std::span<const char> bytes, const PlyHeader& header, PlyTarget& target) {
  const bool isLittle = header.encoding == PlyEncoding::BinaryLittleEndian;
  if (isLittle == kIsHostLittle) {
    BinaryBody<false>(bytes, header, target).read();
  } else {
    BinaryBody<true>(bytes, header, target).read();
  }
}

}  // namespace asdfvk
