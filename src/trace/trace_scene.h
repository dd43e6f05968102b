#pragma once

#include <cstdint>
#include <span>

#include "bvh/bvh.h"
#include "cone/touching_ball.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Mesh and hierarchy for the tests of rays and balls. Has views only; the viewed data must outlive the tracer.
struct TraceScene {
  TriangleMesh mesh;
  const FaceGeometry& geometry;
  std::span<const uint32_t> representatives;  ///< #F, see coincidentRepresentatives().
  const Bvh& bvh;

  /// Returns normalised coordinates.
  [[nodiscard]] Vec3d originOf(uint32_t face) const {
    return bvh.normalization.toNormalized(geometry.barycentres[face]);
  }
};

/// A ray length is the distance to the plane of the hit face, unless this distance differs from the float32 distance of
/// the hit by more than this number (normalised units). The distances differ by more only on slivers.
inline constexpr double kPlaneTolerance = 0x1p-14;

/// Returns normalised coordinates.
[[nodiscard]] inline PlaneTriangle triangleOf(const TraceScene& scene, uint32_t face) {
  return {scene.bvh.normalization.normalizedCorners(scene.mesh, face), scene.geometry.normals[face]};
}

}  // namespace asdfvk
