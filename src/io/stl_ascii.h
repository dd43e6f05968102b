#pragma once

#include <span>

#include "asdf_vk/mesh.h"

namespace asdfvk {

/// Whether the first word after lines of comments is `solid`.
[[nodiscard]] bool beginsWithSolid(std::span<const char> bytes);
/// Throws Error{UnreadableInput} with the line.
[[nodiscard]] Mesh parseAsciiStl(std::span<const char> bytes);

}  // namespace asdfvk
