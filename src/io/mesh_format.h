#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "io/mesh_reader.h"

namespace asdfvk {

/// The format that the content shows; where it shows none, the one that the extension names. An OBJ has no magic
/// number: its first word is one of OBJ's keywords.
[[nodiscard]] std::optional<MeshFormat> detectFormat(std::span<const char> bytes, std::string_view extension);

inline constexpr uint64_t kStlHeaderSize = 84;  ///< 80 bytes of anything, then the face count.
inline constexpr uint64_t kStlFaceSize = 50;    ///< Normal and corners in float32, then two attribute bytes.

/// What binary STL has as its face count. Precondition: at least kStlHeaderSize bytes.
[[nodiscard]] uint64_t binaryStlFaceCount(std::span<const char> bytes);
/// Whether the size is to the byte that of a binary STL. No text has it: four printable bytes are a huge face count.
[[nodiscard]] bool isBinaryStlSize(std::span<const char> bytes);
[[nodiscard]] bool beginsWithSolid(std::span<const char> bytes);

}  // namespace asdfvk
