#include "predict/reprojected_cone.h"

#include <algorithm>
#include <cmath>

namespace asdfvk {
namespace {

// What a cosine in lanes may be off by: so that the rays of a cone narrower than that are in it.
constexpr double kCosineSlack = 2e-6;

}  // namespace

const ConeKernel& coneKernel(InstructionSet instructionSet) {
  switch (instructionSet) {
    case InstructionSet::Avx512:
      return avx512ConeKernel();
    case InstructionSet::Avx2:
      return avx2ConeKernel();
    case InstructionSet::Baseline:
      break;
  }
  return baselineConeKernel();
}

ReprojectedCone::ReprojectedCone(const Cone& cone, const ConeKernel& kernel) : kernel_(kernel) {
  const double leastAngle = 1 / *std::max_element(cone.weights.begin(), cone.weights.end());
  rules_.leastCosine = static_cast<float>(std::cos(cone.halfAngleRadians) - kCosineSlack);
  rules_.greatestFacing = static_cast<float>(cone.falseHitCosine);
  rules_.leastVersine = static_cast<float>(2 * std::pow(std::sin(leastAngle / 2), 2));
  rules_.outlierDeviations = static_cast<float>(cone.outlierDeviations);
}

double ReprojectedCone::value(const std::vector<PointGroup>& groups, std::span<const WeighedCone> cones,
                              const VirtualCone& at, float typicalLength) {
  size_t groupCount = 0;
  for (const WeighedCone& cone : cones) groupCount += cone.groupCount;
  scratch_.resize(std::max(scratch_.size(), 3 * kLaneCount * groupCount));
  const ConeKernel::Seen seen{groups.data(), cones.data(), cones.size(), typicalLength, scratch_.data()};
  return static_cast<double>(kernel_.value(rules_, seen, at));
}

}  // namespace asdfvk
