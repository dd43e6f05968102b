#include "pipeline/space_parts.h"

#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "mesh/cavities.h"
#include "mesh/closed_surface.h"
#include "trace/nearest_point.h"

namespace asdfvk {
namespace {

/// For each face, a face of lower index on which its barycentre lies, with the same normal; itself if there is none.
/// Where bodies overlap and have a plane in common, both have a face there.
std::vector<uint32_t> findRepeated(const PreparedScene& scene) {
  constexpr double kSameNormal = 1 - 1e-6;
  const TraceScene view = scene.view();
  const auto& normals = scene.prepared.geometry.normals;
  std::vector<uint32_t> onFace(view.mesh.faceCount());
  forEachInParallel(onFace.size(), [&](uint32_t face) {
    onFace[face] = face;
    if (scene.prepared.geometry.isDegenerate(face)) return;
    const uint32_t first = scene.prepared.representatives[face];
    const SurfacePoint found = nearestSurfacePoint(view, view.originOf(face), 0, [&](uint32_t other) {
      return other < face && dot(normals[other], normals[face]) > kSameNormal ? other : kNoFace;
    });
    if (first != face)
      onFace[face] = first;
    else if (found.face != kNoFace && length(found.point - view.originOf(face)) <= kContactDistance)
      onFace[face] = found.face;
  });
  return onFace;
}

/// Six times the volume between each part and a point of it.
std::vector<double> volumesOf(const TriangleMesh& mesh, const Components& parts) {
  std::vector<double> volumes(parts.components.size(), 0);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const uint32_t part = parts.componentOf[face];
    const Vec3d& origin = mesh.vertices[mesh.faces[parts.components[part].firstFace][0]];
    const auto [i, j, k] = mesh.faces[face];
    volumes[part] += dot(mesh.vertices[i] - origin, cross(mesh.vertices[j] - origin, mesh.vertices[k] - origin));
  }
  return volumes;
}

}  // namespace

SpaceParts findSpaceParts(const PreparedScene& scene, FunctionRef<bool(uint32_t)> boundsMaterial, bool mayRepeat) {
  const PreparedMesh& prepared = scene.prepared;
  const uint32_t faceCount = prepared.mesh.faceCount();
  const std::vector<uint32_t> onFace = mayRepeat ? findRepeated(scene) : std::vector<uint32_t>();
  std::vector<Face> faces;
  std::vector<uint32_t> faceOf, indexOf(faceCount);
  for (uint32_t face = 0; face < faceCount; ++face) {
    if (mayRepeat && onFace[face] != face) continue;
    indexOf[face] = static_cast<uint32_t>(faces.size());
    faces.push_back(prepared.mesh.faces[face]);
    faceOf.push_back(face);
  }
  TriangleMesh mesh;
  mesh.vertices = prepared.mesh.vertices;
  mesh.faces = faces;
  const SurfaceEdges edges = surveySurface(mesh, scene.bvh.normalization);
  if (!edges.faces.empty()) mesh.faces = edges.faces;
  const Components parts = findComponents(mesh, edges.survey);
  const std::vector<double> volumes = volumesOf(mesh, parts);
  SpaceParts result{{std::vector<uint32_t>(faceCount), std::vector<uint8_t>(parts.components.size(), 0)}, {}};
  for (uint32_t face = 0; face < faceCount; ++face) {
    uint32_t kept = face;
    while (mayRepeat && onFace[kept] != kept) kept = onFace[kept];
    result.solids.solidOf[face] = parts.componentOf[indexOf[kept]];
  }
  const auto isOfClosedBody = [&](uint32_t face) {
    const Component& body = prepared.components.components[prepared.components.componentOf[face]];
    return body.isClosed && body.isConsistentlyWound && boundsMaterial(face);
  };
  for (uint32_t part = 0; part < parts.components.size(); ++part) {
    const uint32_t face = faceOf[parts.components[part].firstFace];
    if (!(volumes[part] > 0) || !isOfClosedBody(face)) continue;
    result.solids.isClosed[part] = parts.components[part].isClosed ? 1 : 0;
    result.voids.push_back({part, volumes[part] / 6, face, {}});
  }
  if (result.voids.empty()) return result;
  const std::vector<uint32_t> parentOf = findCavities(mesh, parts).parentOf;
  for (EnclosedSpace& each : result.voids)
    for (uint32_t part = 0; part < parts.components.size(); ++part) {
      if (part == each.part || parentOf[part] != each.part) continue;
      each.volume += volumes[part] / 6;
      each.looseFaces.push_back(faceOf[parts.components[part].firstFace]);
    }
  return result;
}

}  // namespace asdfvk
