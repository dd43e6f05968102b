#pragma once

#include <cstdint>
#include <span>

#include "bvh/bvh.h"
#include "cone/touching_ball.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// The mesh and the hierarchy that rays and balls are tested against. Views only: everything must outlive the tracer.
struct TraceScene {
  TriangleMesh mesh;
  const FaceGeometry& geometry;
  std::span<const uint32_t> representatives;  ///< #F, see coincidentRepresentatives().
  const Bvh& bvh;

  /// The barycentre of a face in normalised coordinates.
  [[nodiscard]] Vec3d originOf(uint32_t face) const {
    return bvh.normalization.toNormalized(geometry.barycentres[face]);
  }
};

/// A face in normalised coordinates.
[[nodiscard]] inline PlaneTriangle triangleOf(const TraceScene& scene, uint32_t face) {
  const Face& corners = scene.mesh.faces[face];
  const auto corner = [&](size_t k) { return scene.bvh.normalization.toNormalized(scene.mesh.vertices[corners[k]]); };
  return {{corner(0), corner(1), corner(2)}, scene.geometry.normals[face]};
}

}  // namespace asdfvk
