#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "asdf_vk/mesh.h"
#include "core/parallel.h"
#include "core/text.h"
#include "io/input_failure.h"
#include "io/ply_header.h"
#include "io/text_scanner.h"

namespace asdfvk {

/// Reads a number at the address `at`, which may be unaligned.
template <typename T, bool kIsSwapped>
[[nodiscard]] T loadScalar(const char* at) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if constexpr (kIsSwapped)
    for (size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
  return std::bit_cast<T>(bytes);
}

/// Reads a number of a PLY type. Out: double, or int64_t, in which a number from 2^63 on becomes negative.
template <typename Out, bool kIsSwapped>
[[nodiscard]] Out loadPly(const char* at, PlyType type) {
  switch (type) {
    case PlyType::Int8:
      return static_cast<Out>(loadScalar<int8_t, kIsSwapped>(at));
    case PlyType::UInt8:
      return static_cast<Out>(loadScalar<uint8_t, kIsSwapped>(at));
    case PlyType::Int16:
      return static_cast<Out>(loadScalar<int16_t, kIsSwapped>(at));
    case PlyType::UInt16:
      return static_cast<Out>(loadScalar<uint16_t, kIsSwapped>(at));
    case PlyType::Int32:
      return static_cast<Out>(loadScalar<int32_t, kIsSwapped>(at));
    case PlyType::UInt32:
      return static_cast<Out>(loadScalar<uint32_t, kIsSwapped>(at));
    case PlyType::Int64:
      return static_cast<Out>(loadScalar<int64_t, kIsSwapped>(at));
    case PlyType::UInt64:
      return static_cast<Out>(loadScalar<uint64_t, kIsSwapped>(at));
    case PlyType::Float32:
      return static_cast<Out>(loadScalar<float, kIsSwapped>(at));
    case PlyType::Float64:
      break;
  }
  // Float64 is read after the switch, because a default case would cause a warning of GCC 14.
  return static_cast<Out>(loadScalar<double, kIsSwapped>(at));
}

/// Whether all bytes are zero, blanks, line breaks, or the end of a text in DOS (Ctrl-Z).
[[nodiscard]] inline bool isPlyPadding(std::span<const char> bytes) {
  return std::all_of(bytes.begin(), bytes.end(),
                     [](char c) { return std::string_view("\0 \t\n\r\x1a", 6).find(c) != std::string_view::npos; });
}

// PlyAsciiSource and PlyBinarySource read the numbers after a PLY header through the same functions. expected: name of
// the number in the error message of a truncated file. fail() reports the position of the last number. takePoints() and
// takeTriangles() read the first rows of an element without a check per number. They stop before the first row that is
// invalid or has another layout, and return the number of rows that were read.

/// Rows of text. A row may continue on further lines, but must begin on a new line. If a row has too many values, the
/// error message therefore has the line of this row.
class PlyAsciiSource {
 public:
  PlyAsciiSource(std::span<const char> bytes, const PlyHeader& header)
      : text_(bytes.subspan(header.bodyOffset), {}, header.bodyLine) {}

  [[nodiscard]] uint64_t remaining() const { return text_.remaining(); }
  /// Whether the rest of the file can hold `count` rows of at least minRowSize bytes. The last row needs no line break.
  [[nodiscard]] bool canHoldRows(uint64_t count, uint64_t minRowSize) const {
    return count <= (text_.remaining() + 1) / minRowSize;
  }
  [[nodiscard]] bool canHoldItems(uint64_t count, PlyType) const { return count <= text_.remaining(); }

  double number(PlyType, std::string_view expected) { return text_.number(expected); }
  int64_t integer(PlyType, std::string_view expected) { return text_.integer(expected); }
  void skip(uint64_t count, PlyType, std::string_view expected) {
    for (uint64_t i = 0; i < count; ++i) static_cast<void>(text_.number(expected));
  }
  void endRow(const PlyElement& element, uint64_t row) {
    if (!text_.atLineEnd())
      fail(fmt::format("row {} of element {} has more numbers than the header lists", row, quoted(element.name)));
  }
  /// Returns the size of padding after the last row.
  uint64_t requireEnd() {
    const uint64_t size = text_.atEnd() ? 0 : text_.remaining();
    if (!isPlyPadding({text_.position(), static_cast<size_t>(size)})) text_.requireEnd("the last row");
    return size;
  }
  uint64_t takePoints(const PlyElement&, std::vector<Vec3d>&) { return 0; }
  uint64_t takeTriangles(const PlyElement&, uint64_t, std::vector<Face>&) { return 0; }

  [[noreturn]] void fail(std::string_view reason) const { failAtLine(text_.line(), reason); }

 private:
  TextScanner text_;
};

/// kIsSwapped: the byte orders of file and host differ.
template <bool kIsSwapped>
class PlyBinarySource {
 public:
  PlyBinarySource(std::span<const char> bytes, const PlyHeader& header)
      : bytes_(bytes), at_(header.bodyOffset), last_(at_) {}

  [[nodiscard]] uint64_t remaining() const { return bytes_.size() - at_; }
  [[nodiscard]] bool canHoldRows(uint64_t count, uint64_t minRowSize) const {
    return count <= remaining() / minRowSize;
  }
  [[nodiscard]] bool canHoldItems(uint64_t count, PlyType type) const { return count <= remaining() / sizeOf(type); }

  double number(PlyType type, std::string_view expected) { return take<double>(type, expected); }
  int64_t integer(PlyType type, std::string_view expected) { return take<int64_t>(type, expected); }
  /// Precondition: canHoldItems(count, type).
  void skip(uint64_t count, PlyType type, std::string_view) { at_ += count * sizeOf(type); }
  void endRow(const PlyElement&, uint64_t) {}
  /// Returns the size of padding after the last row: up to three bytes, or more if they are padding.
  [[nodiscard]] uint64_t requireEnd() const {
    if (remaining() > 3 && !isPlyPadding(bytes_.subspan(at_)))
      failAtByte(at_, "unexpected " + counted(remaining(), "byte") + " after the last row");
    return remaining();
  }

  /// Sets the points of rows without lists. points: an entry per row.
  uint64_t takePoints(const PlyElement& element, std::vector<Vec3d>& points) {
    if (element.listCount != 0) return 0;
    return takeRows(element, 0, [&](uint64_t index, const char* row) {
      for (size_t axis = 0; axis < 3; ++axis) {
        const PlyProperty& property = element.properties[element.coordinates[axis]];
        points[index][axis] = loadPly<double, kIsSwapped>(row + property.offset, property.type);
      }
      return true;
    });
  }
  /// Sets the triangles of rows whose only list has a length of one byte and three indices of four bytes, all below
  /// vertexCount.
  uint64_t takeTriangles(const PlyElement& element, uint64_t vertexCount, std::vector<Face>& triangles) {
    const PlyProperty& list = element.properties[element.indices];
    if (element.listCount != 1 || sizeOf(*list.list) != 1 || sizeOf(list.type) != 4) return 0;
    const uint64_t maxCount = std::min(element.count, remaining() / (element.rowSize + sizeof(Face)));
    if (maxCount == 0 || bytes_[at_ + list.offset] != 3) return 0;
    triangles.resize(maxCount);
    // From 2^31 on, an index of a signed type is negative.
    const uint64_t end = std::min(vertexCount, uint64_t{1} << 31);
    const uint64_t count = takeRows(element, sizeof(Face), [&](uint64_t index, const char* row) {
      const char* const length = row + list.offset;
      Face& face = triangles[index];
      for (size_t i = 0; i < 3; ++i) face[i] = loadScalar<uint32_t, kIsSwapped>(length + 1 + i * sizeof(uint32_t));
      return *length == 3 && face[0] < end && face[1] < end && face[2] < end;
    });
    triangles.resize(count);
    return count;
  }

  [[noreturn]] void fail(std::string_view reason) const { failAtByte(last_, reason); }

 private:
  template <typename Out>
  Out take(PlyType type, std::string_view expected) {
    last_ = at_;
    if (remaining() < sizeOf(type))
      fail(fmt::format("the file ends where {} is expected; it is truncated; copy or export it again",
                       printable(expected)));
    const Out value = loadPly<Out, kIsSwapped>(bytes_.data() + at_, type);
    at_ += sizeOf(type);
    return value;
  }

  /// Calls read(index, row) in parallel, for rows of which each has listBytes bytes in lists. Takes the rows before the
  /// first row for which read() returns false, and returns their number. May also call read() for later rows.
  template <typename Read>
  uint64_t takeRows(const PlyElement& element, uint64_t listBytes, const Read& read) {
    const uint64_t rowSize = element.rowSize + listBytes;
    const uint64_t maxCount = std::min(element.count, remaining() / rowSize);
    const char* const first = bytes_.data() + at_;
    const auto untakenCount = [&](size_t begin, size_t end) -> uint64_t {
      for (size_t row = begin; row < end; ++row)
        if (!read(row, first + row * rowSize)) return maxCount - row;
      return 0;
    };
    const uint64_t count = maxCount - foldInParallel<uint64_t>(maxCount, untakenCount,
                                                               [](uint64_t a, uint64_t b) { return std::max(a, b); });
    at_ += count * rowSize;
    if (count > 0) last_ = at_ - sizeOf(element.properties.back().type);
    return count;
  }

  std::span<const char> bytes_;
  uint64_t at_;    ///< Position of the next byte.
  uint64_t last_;  ///< Position of the first byte of the last number.
};

}  // namespace asdfvk
