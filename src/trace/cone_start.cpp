#include "trace/cone_start.h"

#include <cmath>

#include "mesh/coincident_faces.h"

namespace asdfvk {

ConeFrame seedConeFrame(const TraceScene& scene, const Cone& cone, uint32_t face) {
  const Vec3d& normal = scene.geometry.normals[face];
  if (cone.definition == Definition::Paper) return paperConeFrame(cone, normal, face);
  // Uses the corners of the mesh. After scaling or a shift, coordinates of the normal that are exactly 0 would no
  // longer be 0.
  const auto [i, j, k] = scene.mesh.faces[face];
  const Vec3d& a = scene.mesh.vertices[i];
  const Vec3d inward = -cross(scene.mesh.vertices[j] - a, scene.mesh.vertices[k] - a);
  const double norm = length(inward);  // May overflow or underflow in extreme units.
  return cgalConeFrame(norm > 0 && std::isfinite(norm) ? inward : -normal);
}

ConeStart coneStartAt(const Cone& cone, const Vec3d& origin, const Vec3d& normal) {
  const ConeFrame frame =
      cone.definition == Definition::Paper ? paperConeFrame(cone, normal, hashOf(origin)) : cgalConeFrame(-normal);
  return {origin, normal, frame, kNoFace};
}

}  // namespace asdfvk
