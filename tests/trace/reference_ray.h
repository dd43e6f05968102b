#pragma once

#include "mesh/mesh.h"
#include "trace/reference_tracer.h"

namespace asdfvk {

/// Length of one ray in the mesh's unit, or kNoValue for an invalid ray (no hit, or a false hit). Precondition: the
/// seed face is not degenerate.
inline double referenceRayLength(const TraceScene& scene, const Cone& cone, const Vec3d& direction, uint32_t seedFace) {
  const std::span<const Vec3d> normals = scene.geometry.normals;
  const RayHit hit = nearestHitFromAnywhere(scene, scene.originOf(seedFace), direction, scene.representatives[seedFace],
                                            cone.contactDistance);
  if (hit.face == kNoFace || isFalseHit(cone, normals[seedFace], direction, normals[hit.face])) return kNoValue;
  return scene.bvh.normalization.toMeshLength(hit.distance);
}

}  // namespace asdfvk
