#include "predict/plain_twin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/mesh.h"
#include "shared/cone_rules.h"

namespace asdfvk::test {
namespace {

constexpr double kMaxChange = 4;
constexpr double kPooledShare = 0.75;
// Tolerance of the median over the deviation: an interval of two deviations bisected four times, plus rounding.
constexpr double kMedianSlack = 1.01 / 8;

struct VisibleHit {
  double length = 0, mass = 0, angle = 0;
  bool isInlierOfSeed = false;
};

std::vector<VisibleHit> visibleFrom(const Cone& cone, const std::vector<PointGroup>& groups,
                                    std::span<const WeightedRange> ranges, const VirtualCone& at) {
  const bool isPaper = cone.definition == Definition::Paper;
  double minAngle = std::numeric_limits<double>::max();
  for (const double weight : cone.weights) minAngle = std::min(minAngle, 1 / weight);
  if (!isPaper) minAngle = *std::min_element(cone.solidAngles.begin(), cone.solidAngles.end());
  std::vector<VisibleHit> visible;
  const auto add = [&](const PointGroup& group, size_t lane, float weight) {
    const Vec3d offset = Vec3d{group.x[lane], group.y[lane], group.z[lane]} - at.origin;
    const Vec3d normal{group.nx[lane], group.ny[lane], group.nz[lane]};
    if (std::isnan(offset.x) || group.face[lane] == at.face || isFalseHit(cone, at.normal, offset, normal)) return;
    const double distance = length(offset);
    const double cosine = -dot(offset, at.normal) / distance;
    if (cosine < std::cos(cone.halfAngleRadians)) return;
    const double angle = std::max(minAngle, std::acos(std::min(1.0, cosine)));
    const double density = isPaper ? 1 : 1 / (std::sin(angle) * cosine * cosine);
    const double change = std::clamp(density * static_cast<double>(group.solidAngleRatio[lane]) / (distance * distance),
                                     1 / kMaxChange, kMaxChange);
    visible.push_back({.length = distance,
                       .mass = static_cast<double>(weight) * change,
                       .angle = isPaper ? angle : 1,
                       .isInlierOfSeed = group.isInlier[lane] == 1});
  };
  for (const WeightedRange& range : ranges)
    for (uint32_t i = 0; i < range.groupCount; ++i)
      for (size_t lane = 0; lane < kPointGroupSize; ++lane) add(groups[range.firstGroup + i], lane, range.weight);
  std::sort(visible.begin(), visible.end(),
            [](const VisibleHit& a, const VisibleHit& b) { return a.length < b.length; });
  return visible;
}

/// The smallest length up to which at least half of the mass lies.
double medianOf(const std::vector<VisibleHit>& visible, double wholeMass) {
  double below = 0;
  for (const VisibleHit& hit : visible) {
    below += hit.mass;
    if (below >= wholeMass / 2) return hit.length;
  }
  return visible.back().length;
}

double meanAround(const std::vector<VisibleHit>& visible, double median, double bound) {
  double weights = 0, weighted = 0;
  for (const VisibleHit& hit : visible) {
    const bool isInlierOfPool = std::abs(hit.length - median) <= bound;
    const double share = (isInlierOfPool ? kPooledShare : 0) + (hit.isInlierOfSeed ? 1 - kPooledShare : 0);
    weights += hit.mass / hit.angle * share;
    weighted += hit.mass / hit.angle * share * hit.length;
  }
  return weights > 0 ? weighted / weights : kNoValue;
}

/// With medians and bounds sampled within the tolerance of the kernel.
TwinValue cgalTwin(const std::vector<VisibleHit>& visible, double median, double deviation, double mass) {
  constexpr int kSampleCount = 60;
  // Tolerance of the spread over the deviation: an interval of two deviations bisected six times, plus rounding.
  constexpr double kSpreadSlack = 1.01 / 32;
  const auto spreadAbout = [&](double centre) {
    std::vector<VisibleHit> differences = visible;
    for (VisibleHit& hit : differences) hit.length = std::abs(hit.length - centre);
    std::sort(differences.begin(), differences.end(),
              [](const VisibleHit& a, const VisibleHit& b) { return a.length < b.length; });
    return medianOf(differences, mass);
  };
  TwinValue value{meanAround(visible, median, 1.5 * spreadAbout(median)), {}};
  value.admissible.push_back(value.exact);
  for (int i = -kSampleCount; i <= kSampleCount; ++i) {
    const double centre = median + kMedianSlack * deviation * i / kSampleCount;
    const double spread = spreadAbout(centre);
    for (int j = -kSampleCount; j <= kSampleCount; ++j)
      value.admissible.push_back(
          meanAround(visible, centre, 1.5 * (spread + kSpreadSlack * deviation * j / kSampleCount)));
  }
  return value;
}

}  // namespace

TwinValue plainTwin(const Cone& cone, const std::vector<PointGroup>& groups, std::span<const WeightedRange> ranges,
                    const VirtualCone& at) {
  const std::vector<VisibleHit> visible = visibleFrom(cone, groups, ranges, at);
  if (visible.empty()) return {kNoValue, {}};
  double mass = 0, mean = 0, squares = 0;
  for (const VisibleHit& hit : visible) {
    mass += hit.mass;
    mean += hit.mass * hit.length;
  }
  mean /= mass;
  for (const VisibleHit& hit : visible) squares += hit.mass * (hit.length - mean) * (hit.length - mean);
  const double median = medianOf(visible, mass);
  const double deviation = std::sqrt(squares / mass);
  if (cone.definition == Definition::Cgal) return cgalTwin(visible, median, deviation, mass);
  const double bound = cone.outliers.deviations * deviation + static_cast<double>(kOutlierSlack) * median;

  TwinValue value{meanAround(visible, median, bound), {}};
  // The mean changes only where a length enters or leaves the window, so that one median per interval in between is
  // enough.
  const double slack = kMedianSlack * deviation;
  std::vector<double> changes{median - slack, median + slack};
  for (const VisibleHit& hit : visible)
    for (const double change : {hit.length - bound, hit.length + bound})
      if (std::abs(change - median) < slack) changes.push_back(change);
  std::sort(changes.begin(), changes.end());
  value.admissible.push_back(value.exact);
  for (size_t i = 0; i + 1 < changes.size(); ++i)
    value.admissible.push_back(meanAround(visible, 0.5 * (changes[i] + changes[i + 1]), bound));
  return value;
}

}  // namespace asdfvk::test
