#include "predict/plain_twin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/mesh.h"
#include "shared/cone_rules.h"

namespace asdfvk::test {
namespace {

constexpr double kLargestChange = 4;
constexpr double kShareOfPool = 0.75;
// Of the deviation: two deviations halved four times, and a little for rounding.
constexpr double kMedianSlack = 1.01 / 8;

struct SeenHit {
  double length = 0, mass = 0, angle = 0;
  bool isKeptBySeed = false;
};

std::vector<SeenHit> seenFrom(const Cone& cone, const std::vector<PointGroup>& groups,
                              std::span<const WeighedCone> cones, const VirtualCone& at) {
  double leastAngle = std::numeric_limits<double>::max();
  for (const double weight : cone.weights) leastAngle = std::min(leastAngle, 1 / weight);
  std::vector<SeenHit> seen;
  const auto look = [&](const PointGroup& group, size_t lane, float weight) {
    const Vec3d way = Vec3d{group.x[lane], group.y[lane], group.z[lane]} - at.origin;
    const Vec3d normal{group.nx[lane], group.ny[lane], group.nz[lane]};
    if (std::isnan(way.x) || group.face[lane] == at.face || dot(at.normal, normal) > cone.falseHitCosine) return;
    const double distance = length(way);
    const double cosine = -dot(way, at.normal) / distance;
    if (cosine < std::cos(cone.halfAngleRadians)) return;
    const double change = std::clamp(static_cast<double>(group.solidAngleRatio[lane]) / (distance * distance),
                                     1 / kLargestChange, kLargestChange);
    seen.push_back({.length = distance,
                    .mass = static_cast<double>(weight) * change,
                    .angle = std::max(leastAngle, std::acos(std::min(1.0, cosine))),
                    .isKeptBySeed = group.isInlier[lane] == 1});
  };
  for (const WeighedCone& weighed : cones)
    for (uint32_t i = 0; i < weighed.groupCount; ++i)
      for (size_t lane = 0; lane < kPointGroupSize; ++lane) look(groups[weighed.firstGroup + i], lane, weighed.weight);
  std::sort(seen.begin(), seen.end(), [](const SeenHit& a, const SeenHit& b) { return a.length < b.length; });
  return seen;
}

/// The least length up to which half of the mass lies.
double medianOf(const std::vector<SeenHit>& seen, double wholeMass) {
  double below = 0;
  for (const SeenHit& hit : seen) {
    below += hit.mass;
    if (below >= wholeMass / 2) return hit.length;
  }
  return seen.back().length;
}

double meanAround(const std::vector<SeenHit>& seen, double median, double bound) {
  double weights = 0, weighted = 0;
  for (const SeenHit& hit : seen) {
    const bool isKeptByPool = std::abs(hit.length - median) <= bound;
    const double share = (isKeptByPool ? kShareOfPool : 0) + (hit.isKeptBySeed ? 1 - kShareOfPool : 0);
    weights += hit.mass / hit.angle * share;
    weighted += hit.mass / hit.angle * share * hit.length;
  }
  return weights > 0 ? weighted / weights : kNoValue;
}

}  // namespace

TwinValue plainTwin(const Cone& cone, const std::vector<PointGroup>& groups, std::span<const WeighedCone> cones,
                    const VirtualCone& at) {
  const std::vector<SeenHit> seen = seenFrom(cone, groups, cones, at);
  if (seen.empty()) return {kNoValue, {}};
  double mass = 0, mean = 0, squares = 0;
  for (const SeenHit& hit : seen) {
    mass += hit.mass;
    mean += hit.mass * hit.length;
  }
  mean /= mass;
  for (const SeenHit& hit : seen) squares += hit.mass * (hit.length - mean) * (hit.length - mean);
  const double median = medianOf(seen, mass);
  const double bound = cone.outlierDeviations * std::sqrt(squares / mass) + static_cast<double>(kOutlierSlack) * median;

  TwinValue value{meanAround(seen, median, bound), {}};
  // The mean changes only where a length enters or leaves the window: one median from each stretch between is enough.
  const double slack = kMedianSlack * std::sqrt(squares / mass);
  std::vector<double> changes{median - slack, median + slack};
  for (const SeenHit& hit : seen)
    for (const double change : {hit.length - bound, hit.length + bound})
      if (std::abs(change - median) < slack) changes.push_back(change);
  std::sort(changes.begin(), changes.end());
  value.admissible.push_back(value.exact);
  for (size_t i = 0; i + 1 < changes.size(); ++i)
    value.admissible.push_back(meanAround(seen, 0.5 * (changes[i] + changes[i + 1]), bound));
  return value;
}

}  // namespace asdfvk::test
