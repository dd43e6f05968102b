#include "reprojection/reprojected_cone.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/lanes.h"
#include "mesh/mesh.h"
#include "shared/cone_rules.h"

namespace asdfvk {
namespace {

// A ray stands for the area around its hit; seen from elsewhere that area fills another solid angle. Where the two
// differ by more than this factor the point is near one of them and far from the other, and the area no disc any more.
constexpr float kLargestSpreadChange = 4;

// A kept length counts by halves: what the rules say of all lengths pooled, and what they said in the seed's own cone.
// The first is less noisy, the second what a traced cone would have said, noise included.
constexpr float kPooledShare = 0.5f;

// The pooled median is found to 2^-this of the span of the lengths; it only places a window.
constexpr int kMedianStepCount = 7;

constexpr float kLargest = std::numeric_limits<float>::max();

}  // namespace

ReprojectedCone::ReprojectedCone(const Cone& cone, InstructionSet instructionSet)
    : instructionSet_(instructionSet),
      leastCosine_(static_cast<float>(std::cos(cone.halfAngleRadians))),
      greatestFacing_(static_cast<float>(cone.falseHitCosine)),
      leastAngle_(static_cast<float>(1 / *std::max_element(cone.weights.begin(), cone.weights.end()))),
      outlierDeviations_(static_cast<float>(cone.outlierDeviations)) {}

[[gnu::always_inline]] inline void ReprojectedCone::project(const GatheredHits& hits, const VirtualCone& at,
                                                            std::span<const float> coneWeights) {
  for (std::vector<float>* numbers : {&lengths_, &masses_, &weights_}) numbers->resize(hits.size());
  const auto originX = static_cast<float>(at.origin.x), originY = static_cast<float>(at.origin.y),
             originZ = static_cast<float>(at.origin.z);
  const auto normalX = static_cast<float>(at.normal.x), normalY = static_cast<float>(at.normal.y),
             normalZ = static_cast<float>(at.normal.z);
  const size_t raysPerCone = hits.raysPerCone();
  for (size_t first = 0; first < lengths_.size(); first += kLaneCount) {
    Lanes x, y, z, nx, ny, nz, spread;
    LaneMask face;
    load(x, &hits.x[first]);
    load(y, &hits.y[first]);
    load(z, &hits.z[first]);
    load(nx, &hits.nx[first]);
    load(ny, &hits.ny[first]);
    load(nz, &hits.nz[first]);
    load(spread, &hits.spread[first]);
    load(face, &hits.face[first]);
    x -= originX;
    y -= originY;
    z -= originZ;
    const Lanes squared = x * x + y * y + z * z;
    Lanes length;
    squareRoot(length, squared);
    const Lanes inverse = 1 / length;
    const Lanes cosine = -(x * normalX + y * normalY + z * normalZ) * inverse;
    const Lanes along = (x * nx + y * ny + z * nz) * inverse;
    const Lanes facing = normalX * nx + normalY * ny + normalZ * nz;
    Lanes change = spread * ((along < 0 ? -along : along) + kGrazingSlack) / squared;
    change = change > 1 / kLargestSpreadChange ? change : Lanes{} + 1 / kLargestSpreadChange;
    change = change < kLargestSpreadChange ? change : Lanes{} + kLargestSpreadChange;
    // arccos near 1, by its series: off by less than 3e-3 at 90 degrees and 2e-5 at 60.
    const Lanes u = cosine < 1 ? 1 - cosine : Lanes{};
    Lanes angle;
    squareRoot(angle, 2 * u);
    angle *= 1 + u * (1.0f / 12 + u * (3.0f / 160 + u * (5.0f / 896)));
    angle = angle > leastAngle_ ? angle : Lanes{} + leastAngle_;
    // False for a ray without a hit, whose numbers are NaN.
    const LaneMask counts =
        (cosine >= leastCosine_) & (facing <= greatestFacing_) & (face != static_cast<int32_t>(at.face));
    const Lanes mass = counts ? coneWeights[first / raysPerCone] * change : Lanes{};
    store(&lengths_[first], counts ? length : Lanes{});
    store(&masses_[first], mass);
    store(&weights_[first], mass / angle);
  }
}

[[gnu::always_inline]] inline float ReprojectedCone::weightedMedian(const Lanes& lows, const Lanes& highs,
                                                                    float half) const {
  float low = kLargest, high = 0;
  for (size_t lane = 0; lane < kLaneCount; ++lane) {
    low = std::min(low, lows[lane]);
    high = std::max(high, highs[lane]);
  }
  for (int step = 0; step < kMedianStepCount; ++step) {
    const float middle = 0.5f * (low + high);
    Lanes below{};
    for (size_t i = 0; i < lengths_.size(); i += kLaneCount) {
      Lanes length, mass;
      load(length, &lengths_[i]);
      load(mass, &masses_[i]);
      below += length <= middle ? mass : Lanes{};
    }
    (sumOverLanes(below) >= half ? high : low) = middle;
  }
  return 0.5f * (low + high);
}

[[gnu::always_inline]] inline double ReprojectedCone::valueInLanes(const GatheredHits& hits, const VirtualCone& at,
                                                                   std::span<const float> coneWeights) {
  Lanes masses{}, lengths{};
  project(hits, at, coneWeights);
  Lanes length, mass;
  for (size_t i = 0; i < lengths_.size(); i += kLaneCount) {
    load(length, &lengths_[i]);
    load(mass, &masses_[i]);
    masses += mass;
    lengths += mass * length;
  }
  const float wholeMass = sumOverLanes(masses);
  if (!(wholeMass > 0)) return kNoValue;
  const float mean = sumOverLanes(lengths) / wholeMass;
  Lanes squares{};
  Lanes lows = Lanes{} + kLargest, highs{};
  for (size_t i = 0; i < lengths_.size(); i += kLaneCount) {
    load(length, &lengths_[i]);
    load(mass, &masses_[i]);
    const Lanes off = length - mean;
    squares += mass * off * off;
    const LaneMask counts = mass > 0;
    lows = counts & (length < lows) ? length : lows;
    highs = counts & (length > highs) ? length : highs;
  }
  const float median = weightedMedian(lows, highs, wholeMass / 2);
  const float bound = outlierDeviations_ * std::sqrt(sumOverLanes(squares) / wholeMass) + kOutlierSlack * median;
  Lanes weights{}, weighted{};
  for (size_t i = 0; i < lengths_.size(); i += kLaneCount) {
    Lanes weight, keptBySeed;
    load(length, &lengths_[i]);
    load(weight, &weights_[i]);
    load(keptBySeed, &hits.kept[i]);
    const Lanes off = length - median;
    const Lanes keptByPool = (off <= bound) & (off >= -bound) ? Lanes{} + kPooledShare : Lanes{};
    weight *= (keptByPool + (1 - kPooledShare) * keptBySeed);
    weights += weight;
    weighted += weight * length;
  }
  const float wholeWeight = sumOverLanes(weights);
  return wholeWeight > 0 ? static_cast<double>(sumOverLanes(weighted) / wholeWeight) : kNoValue;
}

#ifdef __x86_64__
// The same operations, hence the same bits, in fewer instructions.
[[gnu::target("avx2")]] double ReprojectedCone::valueWithAvx2(const GatheredHits& hits, const VirtualCone& at,
                                                              std::span<const float> coneWeights) {
  return valueInLanes(hits, at, coneWeights);
}
#else
double ReprojectedCone::valueWithAvx2(const GatheredHits&, const VirtualCone&, std::span<const float>) {
  ASDFVK_CHECK(false);
  return kNoValue;
}
#endif

double ReprojectedCone::value(const GatheredHits& hits, const VirtualCone& at, std::span<const float> coneWeights) {
  return instructionSet_ == InstructionSet::Avx2 ? valueWithAvx2(hits, at, coneWeights)
                                                 : valueInLanes(hits, at, coneWeights);
}

}  // namespace asdfvk
