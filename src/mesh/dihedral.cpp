#include "mesh/dihedral.h"

#include <cmath>

#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {

double signedDihedralAngle(const FaceGeometry& geometry, uint32_t f, uint32_t g) {
  if (geometry.isDegenerate(f) || geometry.isDegenerate(g)) return 0;
  const Vec3d &ofF = geometry.normals[f], &ofG = geometry.normals[g];
  // Unlike the arc cosine, accurate for small angles.
  const double angle = std::atan2(length(cross(ofF, ofG)), dot(ofF, ofG));
  // Halves, so that their difference does not overflow.
  const Vec3d between = geometry.barycentres[g] * 0.5 - geometry.barycentres[f] * 0.5;
  const bool isConcave = dot(ofF, between) > 0 && dot(ofG, between) < 0;
  return isConcave ? angle : -angle;
}

std::vector<double> signedDihedralAngles(const DualGraph& graph, const FaceGeometry& geometry) {
  ASDFVK_CHECK_OP(geometry.normals.size(), ==, size_t{graph.faceCount()});
  std::vector<double> angles(graph.neighbours.size());
  forEachInParallel(graph.faceCount(), [&](uint32_t face) {
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc)
      angles[arc] = signedDihedralAngle(geometry, face, graph.neighbours[arc]);
  });
  return angles;
}

}  // namespace asdfvk
