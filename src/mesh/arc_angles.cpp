#include "mesh/arc_angles.h"

#include <cmath>

#include "core/check.h"
#include "core/prefetch.h"
#include "mesh/arc_values.h"

namespace asdfvk {

double signedDihedralAngle(const FaceGeometry& geometry, uint32_t f, uint32_t g) {
  if (geometry.isDegenerate(f) || geometry.isDegenerate(g)) return 0;
  const Vec3d &ofF = geometry.normals[f], &ofG = geometry.normals[g];
  // The arc tangent is accurate for small angles, unlike the arc cosine.
  const double angle = std::atan2(length(cross(ofF, ofG)), dot(ofF, ofG));
  // The barycentres are halved, so that their difference does not overflow.
  const Vec3d between = geometry.barycentres[g] * 0.5 - geometry.barycentres[f] * 0.5;
  const bool isConcave = dot(ofF, between) > 0 && dot(ofG, between) < 0;
  return isConcave ? angle : -angle;
}

std::vector<float> arcAngles(const DualGraph& graph, const FaceGeometry& geometry) {
  ASDFVK_CHECK_OP(geometry.areas.size(), ==, size_t{graph.faceCount()});
  std::vector<float> angles(graph.neighbours.size());
  const auto angleOf = [&](uint32_t face, uint32_t neighbour) {
    return static_cast<float>(signedDihedralAngle(geometry, face, neighbour));
  };
  setForEachPair(graph, std::span(angles), angleOf, [&](uint32_t neighbour) {
    prefetchMemory(&geometry.areas[neighbour]);
    prefetchMemory(&geometry.normals[neighbour]);
    prefetchMemory(&geometry.barycentres[neighbour]);
  });
  return angles;
}

}  // namespace asdfvk
