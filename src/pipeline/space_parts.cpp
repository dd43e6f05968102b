#include "pipeline/space_parts.h"

#include "bvh/leaf_faces.h"
#include "core/box3.h"
#include "core/parallel.h"
#include "mesh/cavities.h"
#include "mesh/closed_surface.h"
#include "mesh/vertex_welding.h"
#include "trace/nearest_point.h"

namespace asdfvk {
namespace {

/// For each face, a face of lower index on which its barycentre lies, with the same normal; itself if there is none.
/// Where bodies overlap and have a plane in common, both have a face there.
UnsetVector<uint32_t> findRepeated(const PreparedScene& scene) {
  constexpr double kSameNormal = 1 - 1e-6;
  const TraceScene view = scene.view();
  const auto& normals = scene.prepared.geometry.normals;
  UnsetVector<uint32_t> onFace = scene.prepared.representatives;
  forEachInParallel(onFace.size(), [&](uint32_t face) {
    if (scene.prepared.geometry.isDegenerate(face) || onFace[face] != face) return;
    const Vec3d middle = view.originOf(face);
    const auto isNear = [&](const BvhNode& node) {
      return squaredDistanceToBox(node, middle) <= kContactDistance * kContactDistance;
    };
    forEachLeafFace(view.bvh, isNear, [&](uint32_t other) {
      const bool isOn = other < face && dot(normals[other], normals[face]) > kSameNormal &&
                        length(nearestPoint(triangleOf(view, other), middle) - middle) <= kContactDistance;
      if (isOn) onFace[face] = other;
      return !isOn;
    });
  });
  return onFace;
}

struct PartSize {
  double volume = 0, area = 0;
};

std::vector<PartSize> sizesOf(const TriangleMesh& mesh, const Components& parts) {
  std::vector<PartSize> sizes(parts.components.size());
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    PartSize& size = sizes[parts.componentOf[face]];
    const Vec3d& origin = mesh.vertices[mesh.faces[parts.components[parts.componentOf[face]].firstFace][0]];
    const auto [i, j, k] = mesh.faces[face];
    const Vec3d a = mesh.vertices[i] - origin, b = mesh.vertices[j] - origin, c = mesh.vertices[k] - origin;
    size.volume += dot(a, cross(b, c)) / 6;
    size.area += length(cross(b - a, c - a)) / 2;
  }
  return sizes;
}

/// The faces with one vertex for all vertices at a point.
std::vector<Face> weldedAtPoints(const TriangleMesh& mesh, const Normalization& unit) {
  std::vector<uint8_t> isUsed(mesh.vertices.size(), 0);
  for (const Face& face : mesh.faces)
    for (const uint32_t vertex : face) isUsed[vertex] = isFinite(mesh.vertices[vertex]) ? 1 : 0;
  const std::vector<uint32_t> used =
      indicesInParallel(static_cast<uint32_t>(isUsed.size()), [&](uint32_t vertex) { return isUsed[vertex] != 0; });
  const std::vector<uint32_t> vertexOf = weldVertices(mesh, unit, used, kWeldDistance);
  std::vector<Face> faces(mesh.faces.begin(), mesh.faces.end());
  for (Face& face : faces)
    for (uint32_t& vertex : face) vertex = vertexOf[vertex];
  return faces;
}

}  // namespace

SpaceParts findSpaceParts(const PreparedScene& scene, FunctionRef<bool(uint32_t)> boundsMaterial, bool mayOverlap) {
  const PreparedMesh& prepared = scene.prepared;
  const uint32_t faceCount = prepared.mesh.faceCount();
  const UnsetVector<uint32_t> onFace = mayOverlap ? findRepeated(scene) : prepared.representatives;
  std::vector<Face> faces;
  std::vector<uint32_t> faceOf, indexOf(faceCount);
  for (uint32_t face = 0; face < faceCount; ++face) {
    if (onFace[face] != face) continue;
    indexOf[face] = static_cast<uint32_t>(faces.size());
    faces.push_back(prepared.mesh.faces[face]);
    faceOf.push_back(face);
  }
  TriangleMesh mesh;
  mesh.vertices = prepared.mesh.vertices;
  mesh.faces = faces;
  // Bodies that touch at edges only have no vertices in common.
  const std::vector<Face> welded = weldedAtPoints(mesh, scene.bvh.normalization);
  mesh.faces = welded;
  const SurfaceEdges edges = surveySurface(mesh, scene.bvh.normalization);
  if (!edges.faces.empty()) mesh.faces = edges.faces;
  const Components parts = findComponents(mesh, edges.survey);
  const std::vector<PartSize> sizes = sizesOf(mesh, parts);
  SpaceParts result{{std::vector<uint32_t>(faceCount), std::vector<uint8_t>(parts.components.size(), 0)}, {}};
  std::vector<uint8_t> hasRepeated(parts.components.size(), 0);
  for (uint32_t face = 0; face < faceCount; ++face) {
    uint32_t kept = face;
    while (onFace[kept] != kept) kept = onFace[kept];
    const uint32_t part = parts.componentOf[indexOf[kept]];
    result.solids.solidOf[face] = part;
    if (kept != prepared.representatives[face]) hasRepeated[part] = 1;
  }
  const auto isOfClosedBody = [&](uint32_t face) {
    const Component& body = prepared.components.components[prepared.components.componentOf[face]];
    return body.isClosed && body.isConsistentlyWound && boundsMaterial(face);
  };
  const double contact = scene.bvh.normalization.contactLength();
  for (uint32_t part = 0; part < parts.components.size(); ++part) {
    const uint32_t face = faceOf[parts.components[part].firstFace];
    const PartSize& size = sizes[part];
    // The mean width of a space of less than the resolution is a contact.
    if (!(size.volume > contact * size.area) || !isOfClosedBody(face)) continue;
    result.voids.push_back(
        {.part = part, .volume = size.volume, .isCertain = parts.components[part].isClosed && hasRepeated[part] == 0});
  }
  if (result.voids.empty()) return result;
  const std::vector<uint32_t> parentOf = findCavities(mesh, parts).parentOf;
  std::vector<uint32_t> voidOf(parts.components.size(), kNoFace);
  for (uint32_t i = 0; i < result.voids.size(); ++i) voidOf[result.voids[i].part] = i;
  for (uint32_t part = 0; part < parts.components.size(); ++part) {
    if (parentOf[part] == part || voidOf[parentOf[part]] == kNoFace) continue;
    EnclosedSpace& around = result.voids[voidOf[parentOf[part]]];
    around.volume += sizes[part].volume;
    around.looseParts.push_back(part);
  }
  // Other bodies inside would limit the largest ball.
  for (const EnclosedSpace& each : result.voids)
    result.solids.isClosed[each.part] = each.isCertain && each.looseParts.empty() ? 1 : 0;
  return result;
}

}  // namespace asdfvk
