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
  std::vector<Box3d> boxes;  ///< #components; empty for an open component.

  /// The arrays of the mesh and the components must outlive the object.
  ClosedComponents(const TriangleMesh& mesh, const Components& components);

  [[nodiscard]] std::array<Vec3d, 3> triangle(uint32_t face) const {
    return normalization.normalizedCorners(mesh, face);
  }
};

struct Sample {
  uint32_t component = 0;
  Vec3d point;
};

/// Samples of the closed components with isWanted[component] != 0, grouped by component, ascending. Samples are at up
/// to 70 points of a component: points that are spread by area, and the ends of the component along the axes. With tens
/// of thousands of components, the limit falls to 10 points. A point has one sample closely in front of its face and
/// one closely behind.
[[nodiscard]] std::vector<Sample> samplesOf(const ClosedComponents& closed, std::span<const uint8_t> isWanted);

}  // namespace asdfvk
