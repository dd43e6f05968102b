#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asdfvk {

enum class PlyEncoding { Ascii, BinaryLittleEndian, BinaryBigEndian };
enum class PlyType : uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

[[nodiscard]] constexpr uint64_t sizeOf(PlyType type) {
  constexpr std::array<uint8_t, 10> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}
[[nodiscard]] constexpr bool isInteger(PlyType type) { return type < PlyType::Float32; }

struct PlyProperty {
  std::string_view name;
  PlyType type{};               ///< Type of the number, or of the items of a list.
  std::optional<PlyType> list;  ///< Type of the list length; unset for a number.
  uint64_t offset = 0;          ///< Position in a binary row whose lists are empty, in bytes.
};

enum class PlyRole { Other, Vertices, Faces, Strips };

inline constexpr size_t kNoProperty = static_cast<size_t>(-1);

struct PlyElement {
  std::string_view name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
  uint64_t rowSize = 0;    ///< Size of a binary row whose lists are empty, in bytes.
  uint64_t listCount = 0;  ///< Number of properties that are lists.
  PlyRole role = PlyRole::Other;
  /// Indices of the properties x, y, z of Vertices.
  std::array<size_t, 3> coordinates{kNoProperty, kNoProperty, kNoProperty};
  size_t indices = kNoProperty;  ///< Index of the property vertex_indices or vertex_index of Faces and Strips.

  /// In bytes. In ASCII, a number or a list length takes at least a digit and a blank.
  [[nodiscard]] uint64_t minRowSize(PlyEncoding encoding) const {
    return encoding == PlyEncoding::Ascii ? 2 * properties.size() : rowSize;
  }
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;  ///< In file order: one of Vertices, at least one of Faces or Strips.
  uint64_t bodyOffset = 0;           ///< Byte of the first row.
  uint64_t bodyLine = 1;             ///< Line of the first row, in an ASCII file.
  uint64_t vertexCount = 0;          ///< Below 2^32.
  std::vector<std::string> skipped;  ///< See Mesh::skipped.
};

/// Throws Error{UnreadableInput} with the line. Names are views into `bytes`.
[[nodiscard]] PlyHeader parsePlyHeader(std::span<const char> bytes);

}  // namespace asdfvk
