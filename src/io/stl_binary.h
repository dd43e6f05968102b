#pragma once

#include <span>

#include "asdf_vk/mesh.h"

namespace asdfvk {

/// Whether the size is exactly the size of a binary STL with the face count of its header. A text never has this size,
/// because four printable bytes mean a count of more than 500 million faces.
[[nodiscard]] bool hasBinaryStlSize(std::span<const char> bytes);
/// Whether parseBinaryStl() reads the file, although hasBinaryStlSize() may be false.
[[nodiscard]] bool isBinaryStl(std::span<const char> bytes);
/// Throws Error{UnreadableInput} with the size, or the byte at which the faces of the header end.
[[nodiscard]] Mesh parseBinaryStl(std::span<const char> bytes);

}  // namespace asdfvk
