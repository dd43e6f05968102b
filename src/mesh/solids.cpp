#include "mesh/solids.h"

#include <limits>

#include "core/box3.h"
#include "mesh/cavities.h"

namespace asdfvk {
namespace {

bool contains(const Box3d& outer, const Box3d& inner) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (outer.min[axis] > inner.min[axis] || outer.max[axis] < inner.max[axis]) return false;
  return true;
}

}  // namespace

Solids findSolids(const TriangleMesh& mesh, const Components& components) {
  const size_t count = components.components.size();
  Solids solids{std::vector<uint32_t>(mesh.faceCount()), std::vector<uint8_t>(count), std::vector<uint8_t>(count)};
  std::vector<uint8_t> isCavity(count);
  if (count > 1) isCavity = findCavities(mesh, components);
  std::vector<Box3d> boxes(count);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    for (const uint32_t vertex : mesh.faces[face]) boxes[components.componentOf[face]].add(mesh.vertices[vertex]);
  std::vector<uint32_t> solidOfComponent(count);
  for (uint32_t c = 0; c < count; ++c) {
    const Component& component = components.components[c];
    const double outwards = isCavity[c] != 0 ? -component.signedVolume : component.signedVolume;
    solids.isClosed[c] =
        component.isClosed && component.isConsistentlyWound && outwards > 0 && isCavity[c] == 0 ? 1 : 0;
    solids.isMisoriented[c] = component.isClosed && (!component.isConsistentlyWound || outwards < 0) ? 1 : 0;
    solidOfComponent[c] = c;
  }
  for (uint32_t c = 0; c < count; ++c) {
    if (isCavity[c] == 0) continue;
    double least = std::numeric_limits<double>::infinity();
    for (uint32_t outer = 0; outer < count; ++outer) {
      if (isCavity[outer] != 0 || solids.isClosed[outer] == 0 || !contains(boxes[outer], boxes[c])) continue;
      if (boxes[outer].diagonal() >= least) continue;
      least = boxes[outer].diagonal();
      solidOfComponent[c] = outer;
    }
  }
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    solids.solidOf[face] = solidOfComponent[components.componentOf[face]];
  return solids;
}

}  // namespace asdfvk
