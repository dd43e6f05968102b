#pragma once

#include <fmt/core.h>

#include <array>
#include <bit>
#include <cstring>
#include <utility>

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

/// Reads a number of a PLY type. Out: double or int64_t, which hold every value of the integer types.
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
    case PlyType::Float32:
      return static_cast<Out>(loadScalar<float, kIsSwapped>(at));
    case PlyType::Float64:
      break;
  }
  // Float64 is read after the switch, because a default case would cause a warning of GCC 14.
  return static_cast<Out>(loadScalar<double, kIsSwapped>(at));
}

// PlyAsciiSource and PlyBinarySource read the numbers after a PLY header through the same functions. expected: name of
// the number in the error message of a truncated file. fail() reports the position of the last number.

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
  void requireEnd() { text_.requireEnd("the last row"); }

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
  void requireEnd() const {
    if (remaining() != 0) failAtByte(at_, "unexpected " + counted(remaining(), "byte") + " after the last row");
  }

  [[noreturn]] void fail(std::string_view reason) const { failAtByte(last_, reason); }

 private:
  template <typename Out>
  Out take(PlyType type, std::string_view expected) {
    last_ = at_;
    if (remaining() < sizeOf(type))
      fail(fmt::format("the file ends where {} is expected; it is truncated", printable(expected)));
    const Out value = loadPly<Out, kIsSwapped>(bytes_.data() + at_, type);
    at_ += sizeOf(type);
    return value;
  }

  std::span<const char> bytes_;
  uint64_t at_;    ///< Position of the next byte.
  uint64_t last_;  ///< Position of the first byte of the last number.
};

}  // namespace asdfvk
