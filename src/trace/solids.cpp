#include "trace/solids.h"

#include <utility>

#include "core/disjoint_sets.h"
#include "mesh/cavities.h"

namespace asdfvk {

Solids findSolids(const TriangleMesh& mesh, const Components& components) {
  const size_t count = components.components.size();
  Solids solids{std::vector<uint32_t>(mesh.faceCount()), std::vector<uint8_t>(count)};
  Nesting nesting = findCavities(mesh, components);
  for (uint32_t c = 0; c < count; ++c) {
    const Component& component = components.components[c];
    const bool isCavity = nesting.isCavity[c] != 0;
    const double outwards = isCavity ? -component.signedVolume : component.signedVolume;
    solids.isClosed[c] = component.isClosed && component.isConsistentlyWound && outwards > 0 && !isCavity ? 1 : 0;
  }
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const uint32_t component = components.componentOf[face], body = nesting.bodyOf[component];
    solids.solidOf[face] = solids.isClosed[body] != 0 ? body : component;
  }
  solids.parentOf = std::move(nesting.parentOf);
  return solids;
}

void joinSolids(const Components& components, std::span<const std::pair<uint32_t, uint32_t>> meeting, Solids& solids) {
  if (meeting.empty()) return;
  DisjointSets sets(components.components.size());
  const auto solidOf = [&](uint32_t component) { return solids.solidOf[components.components[component].firstFace]; };
  for (const auto& [first, second] : meeting)
    if (solids.isClosed[solidOf(first)] != 0 && solids.isClosed[solidOf(second)] != 0)
      sets.join(solidOf(first), solidOf(second));
  for (uint32_t& solid : solids.solidOf) solid = sets.lowestOf(solid);
  for (uint32_t solid = 0; solid < solids.isClosed.size(); ++solid)
    if (sets.lowestOf(solid) != solid) solids.isClosed[solid] = 0;
}

}  // namespace asdfvk
