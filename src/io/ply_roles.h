#pragma once

#include <span>

#include "io/ply_header.h"

namespace asdfvk {

/// Finds the elements and properties that make a mesh and sets their roles. Returns the vertex count. Throws
/// Error{Input} where one is missing, double or of a type that cannot be.
uint64_t assignPlyRoles(std::span<PlyElement> elements);

}  // namespace asdfvk
