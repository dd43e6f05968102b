#include "poisson/arc_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/check.h"
#include "core/parallel.h"
#include "mesh/dihedral.h"

namespace asdfvk {
namespace {

constexpr double kShortestDistanceRatio = 1e-9;
constexpr double kShortestDistance = 1e-300;  // Keeps weights finite where even the diagonal is next to nothing.
constexpr double kLeastWeight = std::numeric_limits<double>::min();  // Where the distance is beyond all numbers.

// std::hypot neither overflows nor underflows, whatever the mesh's unit.
double extent(const Vec3d& v) { return std::hypot(v.x, v.y, v.z); }

std::vector<double> distanceWeights(const DualGraph& graph, const FaceGeometry& geometry) {
  ASDFVK_CHECK_OP(geometry.barycentres.size(), ==, size_t{graph.faceCount()});
  const double shortest = std::max(kShortestDistanceRatio * extent(geometry.bounds.size()), kShortestDistance);
  std::vector<double> weights(graph.neighbours.size());
  forEachInParallel(graph.faceCount(), [&](size_t face) {
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
      // Halves, so that their difference does not overflow.
      const Vec3d half = geometry.barycentres[graph.neighbours[arc]] * 0.5 - geometry.barycentres[face] * 0.5;
      weights[arc] = std::max(1 / std::max(2 * extent(half), shortest), kLeastWeight);
    }
  });
  return weights;
}

double featureWeight(double dihedralAngle) {
  const double degrees = dihedralAngle * (180 / std::numbers::pi);
  const double ratio = degrees / (degrees > 0 ? kConcaveScaleDegrees : kConvexScaleDegrees);
  return 1 / (1 + ratio * ratio);
}

}  // namespace

std::vector<double> arcWeights(ArcWeights kind, const DualGraph& graph, const FaceGeometry& geometry) {
  switch (kind) {
    case ArcWeights::Distance:
      return distanceWeights(graph, geometry);
    case ArcWeights::Feature:
      break;
  }
  std::vector<double> weights = signedDihedralAngles(graph, geometry);
  forEachInParallel(weights.size(), [&](size_t arc) { weights[arc] = featureWeight(weights[arc]); });
  return weights;
}

}  // namespace asdfvk
