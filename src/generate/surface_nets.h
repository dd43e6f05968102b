#pragma once

#include <cstdint>

#include "generate/capsule_union.h"
#include "generate/generated_shape.h"

namespace asdfvk {

/// The surface of a smooth union of capsules as a closed manifold of about `faceCount` well-shaped triangles, with the
/// part and diameter of each triangle. Surface nets (Gibson, 1998) on a sparse lattice: a vertex per cell that the
/// surface crosses, a quad per crossed lattice edge. Vertices are spread evenly along the surface, and then moved onto
/// the surface by Newton steps. Unlike in the paper, the lattice is first made well-composed, so that the result is a
/// manifold.
[[nodiscard]] GeneratedShape polygonise(const CapsuleUnion& field, uint64_t faceCount);

}  // namespace asdfvk
