#include "mesh/arc_angles.h"

#include <cmath>

#include "core/check.h"
#include "core/prefetch.h"
#include "mesh/arc_values.h"

namespace asdfvk {
namespace {

/// signedDihedralAngle(), where angleOf(sine, cosine) is the angle between the normals.
template <typename AngleOf>
auto signedAngle(const FaceGeometry& geometry, uint32_t f, uint32_t g, const AngleOf& angleOf) {
  if (geometry.isDegenerate(f) || geometry.isDegenerate(g)) return decltype(angleOf(0.0, 0.0)){0};
  const Vec3d &ofF = geometry.normals[f], &ofG = geometry.normals[g];
  const auto angle = angleOf(length(cross(ofF, ofG)), dot(ofF, ofG));
  // The barycentres are halved, so that their difference does not overflow.
  const Vec3d between = geometry.barycentres[g] * 0.5 - geometry.barycentres[f] * 0.5;
  // Branch-free, because the condition is unpredictable.
  const bool isAboveF = dot(ofF, between) > 0, isAboveG = dot(ofG, between) < 0;
  const bool isConcave = isAboveF & isAboveG;
  return isConcave ? angle : -angle;
}

// The arc tangent is accurate for small angles, unlike the arc cosine.
double arcTangent(double sine, double cosine) { return std::atan2(sine, cosine); }

/// arcTangent() rounded to float. Small angles use a power series, which is faster. Where the error of the series could
/// change the rounded result, the arc tangent is used.
float roundedAngle(double sine, double cosine) {
  constexpr double kMaxTangent = 0.25, kMaxError = 1e-11;  // The first omitted term is below 1e-12 of the angle.
  if (sine < kMaxTangent * cosine) {
    const double t = sine / cosine, s = t * t;
    double series = 0;
    for (int k = 17; k > 1; k -= 2) series = s * (1.0 / k - series);
    const double angle = t - t * series;
    const auto low = static_cast<float>(angle * (1 - kMaxError)), high = static_cast<float>(angle * (1 + kMaxError));
    if (low == high) return low;
  }
  return static_cast<float>(arcTangent(sine, cosine));
}

}  // namespace

double signedDihedralAngle(const FaceGeometry& geometry, uint32_t f, uint32_t g) {
  return signedAngle(geometry, f, g, arcTangent);
}

std::vector<float> arcAngles(const DualGraph& graph, const FaceGeometry& geometry) {
  ASDFVK_CHECK_OP(geometry.areas.size(), ==, size_t{graph.faceCount()});
  std::vector<float> angles(graph.neighbours.size());
  const auto angleOf = [&](uint32_t face, uint32_t neighbour) {
    return signedAngle(geometry, face, neighbour, roundedAngle);
  };
  setForEachPair(graph, std::span(angles), angleOf, [&](uint32_t neighbour) {
    prefetchMemory(&geometry.areas[neighbour]);
    prefetchMemory(&geometry.normals[neighbour]);
    prefetchMemory(&geometry.barycentres[neighbour]);
  });
  return angles;
}

}  // namespace asdfvk
