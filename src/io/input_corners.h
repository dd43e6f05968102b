#pragma once

#include <cstdint>
#include <span>

#include "mesh/mesh.h"

namespace asdfvk {

/// The corners of input face `face` in file order.
[[nodiscard]] inline std::span<const uint32_t> inputFaceCorners(const TriangleMesh& mesh, uint64_t face) {
  if (mesh.polygons.isEmpty()) return mesh.faces[face];
  const std::span<const uint64_t> first = mesh.polygons.firstCorner;
  return {mesh.polygons.corners.data() + first[face], mesh.polygons.corners.data() + first[face + 1]};
}

/// Of all input faces.
[[nodiscard]] inline uint64_t inputCornerCount(const TriangleMesh& mesh) {
  return mesh.polygons.isEmpty() ? 3 * uint64_t{mesh.faceCount()} : mesh.polygons.corners.size();
}

}  // namespace asdfvk
