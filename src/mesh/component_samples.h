#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box3.h"
#include "mesh/components.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// The closed components, in normalised coordinates.
struct ClosedComponents {
  TriangleMesh mesh;
  const Components& components;
  Normalization normalization;
  std::vector<Box3d> boxes;  ///< #components; empty for those that are not closed.

  /// The arrays of the mesh and the components must outlive it.
  ClosedComponents(const TriangleMesh& mesh, const Components& components);

  [[nodiscard]] std::array<Vec3d, 3> triangle(uint32_t face) const;
};

struct Sample {
  uint32_t component = 0;
  Vec3d point;
};

/// Of the closed components with isWanted[component] != 0, grouped by component, ascending: pairs closely in front of
/// and behind at most 70 points of the surface, which are at equal shares of its area and at the ends along the axes;
/// at most 10 where there are tens of thousands of components.
[[nodiscard]] std::vector<Sample> samplesOf(const ClosedComponents& closed, std::span<const uint8_t> isWanted);

}  // namespace asdfvk
