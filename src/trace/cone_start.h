#pragma once

#include <cstdint>

#include "cone/cone.h"
#include "shared/cone_hit.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// The frame of the rays, by Cone::definition. Precondition: the face is not degenerate.
[[nodiscard]] ConeFrame seedConeFrame(const TraceScene& scene, const Cone& cone, uint32_t face);

struct ConeStart {
  Vec3d origin;     ///< Start of the rays, in normalised coordinates.
  Vec3d normal;     ///< Unit vector, outwards. Definition::Paper compares this normal with the normals of hit faces.
  ConeFrame frame;  ///< The axis is minus the normal.
  uint32_t skippedFace = kNoFace;  ///< Hits on this representative are ignored.
};

/// The cone at the barycentre of a face; ignores the face and its copies. Precondition: the face is not degenerate.
[[nodiscard]] inline ConeStart coneStartOfFace(const TraceScene& scene, const Cone& cone, uint32_t face) {
  return {scene.originOf(face), scene.geometry.normals[face], seedConeFrame(scene, cone, face),
          scene.representatives[face]};
}

/// A cone from any origin; its rays may hit every face. normal: a unit vector. ConeRotation::Hashed hashes the origin.
[[nodiscard]] ConeStart coneStartAt(const Cone& cone, const Vec3d& origin, const Vec3d& normal);

}  // namespace asdfvk
