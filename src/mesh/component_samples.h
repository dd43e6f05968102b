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

/// Samples of the closed components with isWanted[component] != 0, grouped by component, ascending. A component has at
/// most 70 points, at equal shares of its area and at the ends along the axes, and a sample closely in front of and
/// behind each. It has at most 10 points where there are tens of thousands of components.
[[nodiscard]] std::vector<Sample> samplesOf(const ClosedComponents& closed, std::span<const uint8_t> isWanted);

}  // namespace asdfvk
