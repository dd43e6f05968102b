#include <algorithm>
#include <iterator>
#include <limits>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "core/length_unit.h"
#include "io/object_names.h"

namespace asdfvk {
namespace {

/// Appends the faces of `from`, whose vertices have the indices from firstVertex on.
void appendFaces(const Mesh& from, uint32_t firstVertex, bool hasPolygons, Mesh& to) {
  const uint64_t firstInputFace = to.inputFaceCount();
  for (const Face& face : from.faces)
    to.faces.push_back({face[0] + firstVertex, face[1] + firstVertex, face[2] + firstVertex});
  if (!hasPolygons) return;
  Polygons& polygons = to.polygons;
  if (polygons.isEmpty()) polygons.firstCorner.push_back(0);
  const auto addCorners = [&](const auto& corners) {
    for (const uint32_t corner : corners) polygons.corners.push_back(corner + firstVertex);
  };
  if (from.polygons.isEmpty()) {
    for (const Face& face : from.faces) {
      addCorners(face);
      polygons.firstCorner.push_back(polygons.corners.size());
      polygons.inputFaceOf.push_back(static_cast<uint32_t>(polygons.firstCorner.size() - 2));
    }
    return;
  }
  const uint64_t firstCorner = polygons.corners.size();
  addCorners(from.polygons.corners);
  for (size_t i = 1; i < from.polygons.firstCorner.size(); ++i)
    polygons.firstCorner.push_back(firstCorner + from.polygons.firstCorner[i]);
  for (const uint32_t face : from.polygons.inputFaceOf)
    polygons.inputFaceOf.push_back(static_cast<uint32_t>(firstInputFace + face));
}

/// Adds the names of the objects of a mesh, or its own name for the faces before the first object.
void appendNames(const Mesh& mesh, uint64_t firstInputFace, const std::string& name, ObjectNames& names) {
  names.begin(firstInputFace, name);
  for (const NamedFaces& object : mesh.objects) names.begin(firstInputFace + object.firstFace, object.name);
}

void requireIndexable(std::span<const Mesh* const> meshes) {
  uint64_t vertexCount = 0, faceCount = 0, inputFaceCount = 0;
  for (const Mesh* const mesh : meshes) {
    vertexCount += mesh->vertices.size();
    faceCount += mesh->faces.size();
    inputFaceCount += mesh->inputFaceCount();
  }
  if (std::max({vertexCount, faceCount, inputFaceCount}) >= std::numeric_limits<uint32_t>::max())
    throw Error(ErrorCode::MeshTooLarge, "the meshes together have more vertices or faces than 32 bits can index");
}

}  // namespace

Mesh joinMeshes(std::span<const Mesh* const> meshes, std::span<const std::string> names) {
  if (names.size() != meshes.size())
    throw Error(ErrorCode::ArraySize, "the number of names is not the number of meshes; give a name per mesh");
  requireIndexable(meshes);
  const bool hasPolygons =
      std::any_of(meshes.begin(), meshes.end(), [](const Mesh* mesh) { return !mesh->polygons.isEmpty(); });
  Mesh joined;
  ObjectNames objects;
  for (size_t i = 0; i < meshes.size(); ++i) {
    const Mesh& mesh = *meshes[i];
    const auto firstVertex = static_cast<uint32_t>(joined.vertices.size());
    appendNames(mesh, joined.inputFaceCount(), names[i], objects);
    joined.vertices.insert(joined.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    appendFaces(mesh, firstVertex, hasPolygons, joined);
    joined.unit = i == 0 ? mesh.unit : commonUnit(joined.unit, mesh.unit);
    joined.statedPartCount += std::max(mesh.statedPartCount, 1u);
    joined.chordError = std::max(joined.chordError, mesh.chordError);
    joined.skipped.insert(joined.skipped.end(), mesh.skipped.begin(), mesh.skipped.end());
    joined.negativeVolumeCount += mesh.negativeVolumeCount;
    joined.float32Step = std::max(joined.float32Step, mesh.float32Step);
  }
  joined.objects = objects.finish(joined.inputFaceCount());
  return joined;
}

}  // namespace asdfvk
