#include "exact_cone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/mesh.h"
#include "shared/cone_rules.h"

namespace asdfvk::bench {
namespace {

struct ExactHit {
  double length = 0;
  double normalCosine = 0;  // Of the angle between the normals at both ends.
};

double medianOf(std::vector<double> lengths) {
  std::sort(lengths.begin(), lengths.end());
  return 0.5 * (lengths[(lengths.size() - 1) / 2] + lengths[lengths.size() / 2]);
}

double standardDeviationOf(const std::vector<double>& lengths) {
  double sum = 0, squares = 0;
  for (const double length : lengths) sum += length;
  const double mean = sum / static_cast<double>(lengths.size());
  for (const double length : lengths) squares += (length - mean) * (length - mean);
  return std::sqrt(squares / static_cast<double>(lengths.size()));
}

}  // namespace

ExactCone::ExactCone(const ConeOptions& options) {
  const double halfAngle = options.openingAngleDegrees / 2 * std::numbers::pi / 180;
  for (uint32_t i = 0; i < options.rayCount; ++i) {
    const double t = std::acos(1 - (i + 0.5) / options.rayCount * (1 - std::cos(halfAngle)));
    const double phi = i * std::numbers::pi * (3 - std::sqrt(5.0));
    directions_.push_back({std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), std::cos(t)});
    weights_.push_back(1 / t);
  }
}

template <typename HitOf>
ExactValue ExactCone::valueOf(const HitOf& hitOf) const {
  ExactValue exact{kNoValue, 1, std::numeric_limits<double>::infinity()};
  std::vector<double> lengths, weights;
  for (size_t i = 0; i < directions_.size(); ++i) {
    const ExactHit hit = hitOf(directions_[i]);
    exact.cosineMargin = std::min(exact.cosineMargin, std::abs(hit.normalCosine - kFalseHitSlack));
    if (hit.normalCosine > kFalseHitSlack) continue;
    lengths.push_back(hit.length);
    weights.push_back(weights_[i]);
  }
  if (lengths.empty()) return exact;
  const double median = medianOf(lengths);
  const double bound = standardDeviationOf(lengths) + kOutlierSlack * median;
  double sum = 0, weightSum = 0;
  for (size_t i = 0; i < lengths.size(); ++i) {
    const double excess = std::abs(lengths[i] - median) - bound;
    exact.lengthMargin = std::min(exact.lengthMargin, std::abs(excess));
    if (excess > 0) continue;
    sum += weights[i] * lengths[i];
    weightSum += weights[i];
  }
  exact.value = sum / weightSum;
  return exact;
}

ExactValue ExactCone::onSphere(double radius) const {
  // The arc between the two ends of a chord is pi - 2 t.
  return valueOf([&](const Vec3d& direction) {
    return ExactHit{2 * radius * direction.z, 1 - 2 * direction.z * direction.z};
  });
}

ExactValue ExactCone::inSlab(double thickness) const {
  return valueOf([&](const Vec3d& direction) { return ExactHit{thickness / direction.z, -1}; });
}

ExactValue ExactCone::inCylinder(double radius, const Vec3d& barycentre, const Vec3d& normal) const {
  const ConeFrame frame = coneFrame(-normal);
  const Vec3d from = Vec3d{barycentre.x, barycentre.y, 0} * (radius / std::hypot(barycentre.x, barycentre.y));
  return valueOf([&](const Vec3d& direction) {
    const Vec3d d = frame.tangent * direction.x + frame.bitangent * direction.y + frame.axis * direction.z;
    const double length = -2 * dot(from, d) / (d.x * d.x + d.y * d.y);
    const Vec3d hit = from + d * length;
    return ExactHit{length, dot(Vec3d{hit.x, hit.y, 0} / radius, normal)};
  });
}

}  // namespace asdfvk::bench
