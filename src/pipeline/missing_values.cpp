#include "pipeline/missing_values.h"

#include <cmath>
#include <vector>

namespace asdfvk {

std::string likelyCauseOfMissingValues(const TriangleMesh& mesh, const PreparedMesh& prepared,
                                       std::span<const double> values) {
  std::vector<uint8_t> isInverted(prepared.components.components.size(), 0);
  for (const uint32_t index : prepared.invertedComponents) isInverted[index] = 1;
  bool isAnyInverted = false, isAnyOpen = false;
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
    if (!std::isnan(values[f]) || prepared.geometry.isDegenerate(f)) continue;
    const uint32_t component = prepared.components.componentOf[f];
    isAnyInverted = isAnyInverted || isInverted[component];
    isAnyOpen = isAnyOpen || !prepared.components.components[component].isClosed;
  }
  isAnyOpen = isAnyOpen && prepared.defects.boundaryEdgeCount > 0;
  const std::string inverted = "their component is inverted (--orient auto turns it over)";
  const std::string open = "the surface is open, so that rays escape, or looks the other way (--orient flip)";
  if (isAnyInverted && isAnyOpen) return inverted + ", or " + open;
  if (isAnyInverted) return inverted;
  return isAnyOpen ? open : std::string();
}

}  // namespace asdfvk
