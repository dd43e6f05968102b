#pragma once

#include <span>
#include <string_view>

#include "asdf_vk/mesh.h"
#include "io/corner_welder.h"

namespace asdfvk {

/// Whether the size is exactly the size of a binary STL with the face count of its header. A text never has this size,
/// because four printable bytes mean a count of more than 500 million faces.
[[nodiscard]] bool hasBinaryStlSize(std::span<const char> bytes);
/// Whether parseBinaryStl() reads the file, although hasBinaryStlSize() may be false.
[[nodiscard]] bool isBinaryStl(std::span<const char> bytes);
/// Throws Error{UnreadableInput} with the size, or the byte at which the faces of the header end.
[[nodiscard]] Mesh parseBinaryStl(std::span<const char> bytes);

/// Whether the first word after lines of comments is `solid`.
[[nodiscard]] bool beginsWithSolid(std::span<const char> bytes);
/// Throws Error{UnreadableInput} with the line.
[[nodiscard]] Mesh parseAsciiStl(std::span<const char> bytes);

/// STL has no indices. Corners at the same point become one vertex, because without common vertices no face would have
/// a neighbour.
[[nodiscard]] Mesh weldedStl(CornerWelder& welder, std::vector<Face>&& triangles);

}  // namespace asdfvk
