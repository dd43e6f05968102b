#pragma once

#include <cstdint>
#include <string>

#include "asdf_vk/mesh.h"

namespace asdfvk {

/// The greatest number of triangles that a page computes. The memory of WebAssembly is limited to 4 GB; a check takes
/// up to 1.5 kB per triangle if all faces are thin, and usually 0.6 kB.
inline constexpr uint64_t kMaxPageTriangleCount = 2'500'000;

/// Throws Error{InputTooLarge} for a mesh with more triangles.
void requireMemory(const Mesh& mesh, const std::string& name);

/// The remedy for a lack of memory.
[[nodiscard]] std::string memoryRemedy();

}  // namespace asdfvk
