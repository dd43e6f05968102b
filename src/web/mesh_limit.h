#pragma once

#include <cstdint>

#include "asdf_vk/mesh.h"

namespace asdfvk {

/// The greatest number of triangles for which the memory of WebAssembly suffices (4 GB, addresses of 32 bits).
inline constexpr uint64_t kMaxPageTriangleCount = 4'000'000;

/// Throws Error{InputTooLarge} for a mesh with more triangles.
void requireMemory(const Mesh& mesh);

}  // namespace asdfvk
