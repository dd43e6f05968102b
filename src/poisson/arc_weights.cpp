#include "poisson/arc_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/check.h"
#include "core/parallel.h"
#include "mesh/curvature.h"

namespace asdfvk {
namespace {

constexpr double kMinDistanceRatio = 1e-9;
constexpr double kMinDistance = 1e-300;                            // Where the diagonal itself is almost 0.
constexpr double kMinWeight = std::numeric_limits<double>::min();  // Where the distance overflows.

// Unlike the root of a sum of squares, std::hypot neither overflows nor underflows in any unit.
double lengthOf(const Vec3d& v) { return std::hypot(v.x, v.y, v.z); }

std::vector<double> distanceWeights(const DualGraph& graph, const FaceGeometry& geometry) {
  ASDFVK_CHECK_OP(geometry.barycentres.size(), ==, size_t{graph.faceCount()});
  const double minDistance = std::max(kMinDistanceRatio * lengthOf(geometry.bounds.size()), kMinDistance);
  std::vector<double> weights(graph.neighbours.size());
  forEachInParallel(graph.faceCount(), [&](size_t face) {
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
      // The difference of the halves does not overflow.
      const Vec3d half = geometry.barycentres[graph.neighbours[arc]] * 0.5 - geometry.barycentres[face] * 0.5;
      weights[arc] = std::max(1 / std::max(2 * lengthOf(half), minDistance), kMinWeight);
    }
  });
  return weights;
}

double featureWeight(double dihedralAngleRadians) {
  const double degrees = dihedralAngleRadians * (180 / std::numbers::pi);
  const double ratio = degrees / (degrees > 0 ? kConcaveScaleDegrees : kConvexScaleDegrees);
  return 1 / (1 + ratio * ratio);
}

}  // namespace

std::vector<double> arcWeights(ArcWeights kind, const DualGraph& graph, const FaceGeometry& geometry) {
  if (kind == ArcWeights::Distance) return distanceWeights(graph, geometry);
  std::vector<double> weights = signedDihedralAngles(graph, geometry);
  forEachInParallel(weights.size(), [&](size_t arc) { weights[arc] = featureWeight(weights[arc]); });
  return weights;
}

}  // namespace asdfvk
