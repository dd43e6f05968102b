#include "mesh/solids.h"

#include <limits>

#include "core/box3.h"
#include "mesh/cavities.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

Solids findSolids(const TriangleMesh& mesh, const Components& components) {
  const size_t count = components.components.size();
  Solids solids{std::vector<uint32_t>(mesh.faceCount()), std::vector<uint8_t>(count), std::vector<uint8_t>(count), {}};
  std::vector<uint8_t> isCavity(count);
  if (count > 1) isCavity = findCavities(mesh, components);
  const double contact = normalizationOf(boundsOfFiniteVertices(mesh)).contactLength();
  std::vector<Box3d> boxes(count);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    for (const uint32_t vertex : mesh.faces[face]) boxes[components.componentOf[face]].add(mesh.vertices[vertex]);
  std::vector<uint32_t> solidOfComponent(count), bodyOfComponent(count, kNoBody);
  for (uint32_t c = 0; c < count; ++c) {
    const Component& component = components.components[c];
    const double outwards = isCavity[c] != 0 ? -component.signedVolume : component.signedVolume;
    solids.isClosed[c] =
        component.isClosed && component.isConsistentlyWound && outwards > 0 && isCavity[c] == 0 ? 1 : 0;
    solids.isMisoriented[c] = component.isClosed && (!component.isConsistentlyWound || outwards < 0) ? 1 : 0;
    solidOfComponent[c] = c;
    if (solids.isClosed[c] != 0) bodyOfComponent[c] = c;
  }
  for (uint32_t c = 0; c < count; ++c) {
    if (isCavity[c] == 0) continue;
    double least = std::numeric_limits<double>::infinity();
    uint32_t candidateCount = 0;
    for (uint32_t outer = 0; outer < count; ++outer) {
      if (solids.isClosed[outer] == 0 || !containsBy(contact, boxes[outer], boxes[c])) continue;
      ++candidateCount;
      if (boxes[outer].diagonal() >= least) continue;
      least = boxes[outer].diagonal();
      solidOfComponent[c] = outer;
    }
    if (candidateCount == 1) bodyOfComponent[c] = solidOfComponent[c];
  }
  solids.bodyOf.resize(mesh.faceCount());
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const uint32_t component = components.componentOf[face];
    solids.solidOf[face] = solidOfComponent[component];
    solids.bodyOf[face] = bodyOfComponent[component];
  }
  return solids;
}

}  // namespace asdfvk
