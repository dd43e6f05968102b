#include "predict/prediction_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"

namespace asdfvk {
namespace {

// Slack for the rounding error of a cosine in float32. With the slack, even a very narrow cone contains its own rays.
constexpr double kCosineSlack = 2e-6;

struct FloatVec3 {
  float x, y, z;
};
ASDFVK_ALWAYS_INLINE inline FloatVec3 toFloat(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Sums of kPointGroupSize numbers side by side. The total has the same bits for any vector width: numbers eight places
/// apart are added first, then four, two and one.
template <typename Floats>
class GroupSum {
 public:
  /// place: index of the first of `numbers` in its group.
  ASDFVK_ALWAYS_INLINE void add(size_t place, const Floats& numbers) { parts_[place / kLaneCount<Floats>] += numbers; }

  [[nodiscard]] ASDFVK_ALWAYS_INLINE float total() const {
    const Float4 four = sumOfFours();
    const Float4 two = four + __builtin_shufflevector(four, four, 2, 3, 2, 3);
    return two[0] + two[1];
  }

 private:
  [[nodiscard]] ASDFVK_ALWAYS_INLINE Float4 sumOfFours() const {
    if constexpr (sizeof(Floats) == sizeof(Float16))
      return sumOfHalves(__builtin_shufflevector(parts_[0], parts_[0], 0, 1, 2, 3, 4, 5, 6, 7) +
                         __builtin_shufflevector(parts_[0], parts_[0], 8, 9, 10, 11, 12, 13, 14, 15));
    else if constexpr (sizeof(Floats) == sizeof(Float8))
      return sumOfHalves(parts_[0] + parts_[1]);
    else
      return (parts_[0] + parts_[2]) + (parts_[1] + parts_[3]);
  }
  [[nodiscard]] ASDFVK_ALWAYS_INLINE static Float4 sumOfHalves(const Float8& eight) {
    return __builtin_shufflevector(eight, eight, 0, 1, 2, 3) + __builtin_shufflevector(eight, eight, 4, 5, 6, 7);
  }

  Floats parts_[kPointGroupSize / kLaneCount<Floats>] = {};
};

/// The seeds of a prediction. buffer: 3 * kPointGroupSize floats per group of the seeds.
struct KernelInput {
  const PointGroup* groups;
  std::span<const WeightedRange> ranges;
  float medianLength;
  float* buffer;
};

/// Sums over the points in a virtual cone.
template <typename Floats>
struct ConeSums {
  /// Sums of the masses, of mass * d, and of mass * d^2. d: length minus median length.
  GroupSum<Floats> mass, difference, square;
  GroupSum<Floats> weight, weightedLength;  ///< Sums over the inliers.
};

/// The hit points: `count` entries in each array, which are 0 for points outside of the virtual cone.
struct ConePoints {
  float* lengths;  ///< Distances from the origin of the virtual cone.
  float* masses;   ///< The number of rays of the virtual cone that the point represents, up to a factor, times the
                   ///< seed's weight.
  float* weights;  ///< Paper: mass divided by the angle to the axis. Cgal: mass.
  size_t count;
};

/// sqrt(x) / arccos(1 - x) for 0 <= x <= 1, with a relative error of 3e-4. A loop of std::acos() takes
/// 24 % more CPU seconds of a whole run (horse, 10 % seeds).
template <typename Floats>
ASDFVK_ALWAYS_INLINE inline Floats sqrtOverAngle(const Floats& x) {
  return 0.706948624f - x * (0.0564995318f + x * 0.0136869098f);
}

template <Definition kDefinition, typename Floats>
ASDFVK_ALWAYS_INLINE inline void project(const PredictionKernel::Rules& rules, const KernelInput& input,
                                         const VirtualCone& at, ConePoints& points, ConeSums<Floats>& sums) {
  using Ints = IntsOf<Floats>;
  const FloatVec3 origin = toFloat(at.origin), normal = toFloat(at.normal);
  const Ints ownFace = broadcast<Ints>(static_cast<int32_t>(at.face));
  const Floats minChange = broadcast<Floats>(1 / kMaxSolidAngleChange),
               maxChange = broadcast<Floats>(kMaxSolidAngleChange);
  const Floats minVersine = broadcast<Floats>(rules.minVersine), minCosine = broadcast<Floats>(rules.minCosine),
               maxNormalCosine = broadcast<Floats>(rules.maxNormalCosine);
  for (const WeightedRange& range : input.ranges) {
    const PointGroup* const begin = input.groups + range.firstGroup;
    const float seedWeight = range.weight;
    for (const PointGroup* group = begin; group < begin + range.groupCount; ++group) {
      for (size_t i = 0; i < kPointGroupSize; i += kLaneCount<Floats>) {
        const Floats x = load<Floats>(group->x + i) - origin.x, y = load<Floats>(group->y + i) - origin.y,
                     z = load<Floats>(group->z + i) - origin.z;
        const Floats inverse = rsqrt(x * x + y * y + z * z);
        const Floats length = (x * x + y * y + z * z) * inverse;
        const Floats cosine = (x * -normal.x + y * -normal.y + z * -normal.z) * inverse;
        const Floats nx = load<Floats>(group->nx + i), ny = load<Floats>(group->ny + i),
                     nz = load<Floats>(group->nz + i);
        const Floats ratio = load<Floats>(group->solidAngleRatio + i) * (inverse * inverse);
        const Floats versine = max(1 - cosine, minVersine);
        Floats normalCosine, change;
        if constexpr (kDefinition == Definition::Paper) {
          normalCosine = nx * normal.x + ny * normal.y + nz * normal.z;
          change = min(max(ratio, minChange), maxChange);
        } else {
          normalCosine = -(nx * x + ny * y + nz * z);
          // The density of rays per solid angle at this angle t to the axis is proportional to 1 / (sin t cos^2 t).
          const Floats density = rsqrt(versine * (2 - versine)) / (cosine * cosine);
          change = min(max(ratio * density, minChange), maxChange);
        }
        // False for a miss, whose numbers are NaN.
        const Ints isInCone = lessEqual(minCosine, cosine) & lessEqual(normalCosine, maxNormalCosine) &
                              notEqual(load<Ints>(group->face + i), ownFace);
        const Floats mass = select(isInCone, seedWeight * change), lengthInCone = select(isInCone, length);
        Floats weight = mass;
        if constexpr (kDefinition == Definition::Paper) weight = mass * (rsqrt(versine) * sqrtOverAngle(versine));
        store(points.lengths + points.count + i, lengthInCone);
        store(points.masses + points.count + i, mass);
        store(points.weights + points.count + i, weight);
        const Floats difference = lengthInCone - input.medianLength, massDifference = mass * difference;
        sums.mass.add(i, mass);
        sums.difference.add(i, massDifference);
        sums.square.add(i, massDifference * difference);
        const Floats inlierWeight = weight * load<Floats>(group->isInlier + i);
        sums.weight.add(i, inlierWeight);
        sums.weightedLength.add(i, inlierWeight * lengthInCone);
      }
      points.count += kPointGroupSize;
    }
  }
}

/// The median is between the lengths `low` and `high`. massToLow, massToHigh: mass of the points up to `low`, and up to
/// `high`.
struct MedianBounds {
  float low, high, massToLow, massToHigh;
};

/// Returns the quarter of the interval in which the mass reaches `halfMass`. keyOf: maps lengths to the numbers whose
/// median is searched. Halves instead of quarters take 1 to 8 % more CPU seconds of a whole run (horse, 10 % seeds).
template <typename Floats, typename KeyOf>
ASDFVK_ALWAYS_INLINE inline MedianBounds quarterOf(const ConePoints& points, const MedianBounds& bounds, float halfMass,
                                                   const KeyOf& keyOf) {
  const float quarter = 0.25f * (bounds.high - bounds.low);
  const Floats first = broadcast<Floats>(bounds.low + quarter), second = broadcast<Floats>(bounds.low + 2 * quarter),
               third = broadcast<Floats>(bounds.low + 3 * quarter);
  GroupSum<Floats> toFirst, toSecond, toThird;
  for (size_t group = 0; group < points.count; group += kPointGroupSize) {
    for (size_t i = 0; i < kPointGroupSize; i += kLaneCount<Floats>) {
      const Floats key = keyOf(load<Floats>(points.lengths + group + i));
      const Floats mass = load<Floats>(points.masses + group + i);
      toFirst.add(i, select(lessEqual(key, first), mass));
      toSecond.add(i, select(lessEqual(key, second), mass));
      toThird.add(i, select(lessEqual(key, third), mass));
    }
  }
  const float masses[3] = {toFirst.total(), toSecond.total(), toThird.total()};
  MedianBounds result = bounds;
  for (int i = 0; i < 3; ++i) {
    const float length = bounds.low + static_cast<float>(i + 1) * quarter;
    if (masses[i] >= halfMass) {
      result.high = length;
      result.massToHigh = masses[i];
      break;
    }
    result.low = length;
    result.massToLow = masses[i];
  }
  return result;
}

template <typename Floats, typename KeyOf>
ASDFVK_ALWAYS_INLINE inline float medianBetween(const ConePoints& points, MedianBounds bounds, uint32_t passCount,
                                                const KeyOf& keyOf) {
  const float halfMass = 0.5f * bounds.massToHigh;
  for (uint32_t pass = 0; pass < passCount; ++pass) bounds = quarterOf<Floats>(points, bounds, halfMass, keyOf);
  const float between = bounds.massToHigh - bounds.massToLow;
  const float share = between > 0 ? (halfMass - bounds.massToLow) / between : 0.5f;
  return bounds.low + share * (bounds.high - bounds.low);
}

template <Definition kDefinition, typename Floats>
ASDFVK_ALWAYS_INLINE inline float predictedValue(const PredictionKernel::Rules& rules, const KernelInput& input,
                                                 const VirtualCone& at) {
  size_t capacity = 0;
  for (const WeightedRange& range : input.ranges) capacity += range.groupCount * kPointGroupSize;
  ConePoints points{input.buffer, input.buffer + capacity, input.buffer + 2 * capacity, 0};
  ConeSums<Floats> sums;
  project<kDefinition>(rules, input, at, points, sums);
  const float mass = sums.mass.total();
  if (!(mass > 0)) return std::numeric_limits<float>::quiet_NaN();
  const float meanDifference = sums.difference.total() / mass,
              variance = sums.square.total() / mass - meanDifference * meanDifference;
  const float mean = input.medianLength + meanDifference, deviation = variance > 0 ? std::sqrt(variance) : 0.0f;
  const float median = medianBetween<Floats>(points, {mean - deviation, mean + deviation, 0, mass}, kMedianPassCount,
                                             [](const Floats& length) ASDFVK_ALWAYS_INLINE { return length; });
  float spread = deviation;
  // The spread is at most twice the deviation, by Chebyshev's inequality.
  if constexpr (kDefinition == Definition::Cgal)
    spread = medianBetween<Floats>(points, {0, 2 * deviation, 0, mass}, kSpreadPassCount,
                                   [median](const Floats& length)
                                       ASDFVK_ALWAYS_INLINE { return max(length - median, median - length); });
  const float bound = rules.outlierDeviations * spread + rules.outlierSlack * median;
  const Floats low = broadcast<Floats>(median - bound), high = broadcast<Floats>(median + bound);
  GroupSum<Floats> pooledWeight, pooledLength;
  for (size_t group = 0; group < points.count; group += kPointGroupSize) {
    for (size_t i = 0; i < kPointGroupSize; i += kLaneCount<Floats>) {
      const Floats length = load<Floats>(points.lengths + group + i);
      const Floats weight =
          select(lessEqual(low, length) & lessEqual(length, high), load<Floats>(points.weights + group + i));
      pooledWeight.add(i, weight);
      pooledLength.add(i, weight * length);
    }
  }
  const float weight = kPooledShare * pooledWeight.total() + (1 - kPooledShare) * sums.weight.total();
  const float sum = kPooledShare * pooledLength.total() + (1 - kPooledShare) * sums.weightedLength.total();
  // If rounding left a deviation of almost 0, no length is kept. In this case all lengths are almost equal.
  return weight > 0 ? sum / weight : mean;
}

template <typename Floats>
ASDFVK_ALWAYS_INLINE inline void weighSeeds(const SeedGroup& seeds, const SeedWeighting& weighting,
                                            const VirtualCone& at, float* weights) {
  const FloatVec3 origin = toFloat(at.origin), normal = toFloat(at.normal);
  for (size_t i = 0; i < kPointGroupSize; i += kLaneCount<Floats>) {
    const Floats x = load<Floats>(seeds.x + i) - origin.x, y = load<Floats>(seeds.y + i) - origin.y,
                 z = load<Floats>(seeds.z + i) - origin.z;
    const Floats cosine = load<Floats>(seeds.nx + i) * normal.x + load<Floats>(seeds.ny + i) * normal.y +
                          load<Floats>(seeds.nz + i) * normal.z;
    const Floats u = max(1 - cosine, Floats{});
    // Series of the square of arccos(1 - u). Its error is 0.3 % at 90 degrees; at larger angles weights are almost 0.
    const Floats angleSquare = u * (2 + u * (1.0f / 3 + u * (4.0f / 45 + u * (1.0f / 35 + u * (16.0f / 1575)))));
    const Floats exponent =
        0.5f * ((x * x + y * y + z * z) * weighting.inverseVariance + angleSquare * weighting.inverseAngleVariance);
    store(weights + i, max(expNegative(min(exponent, broadcast<Floats>(80.0f))), broadcast<Floats>(kMinSeedWeight)));
  }
}

}  // namespace

PredictionKernel::PredictionKernel(const Cone& cone, InstructionSet instructionSet)
    : instructionSet_(instructionSet), rules_(rulesOf(cone)) {}

PredictionKernel::Rules PredictionKernel::rulesOf(const Cone& cone) {
  Rules rules;
  // In CGAL's definition, the ray on the axis has the least entry of solidAngles, sin t cos^2 t. This number is nearly
  // t, the mean angle that the ray represents.
  const double minAngle = cone.definition == Definition::Paper
                              ? 1 / *std::max_element(cone.weights.begin(), cone.weights.end())
                              : *std::min_element(cone.solidAngles.begin(), cone.solidAngles.end());
  rules.minCosine = static_cast<float>(cosine(cone.halfAngleRadians) - kCosineSlack);
  rules.maxNormalCosine = static_cast<float>(cone.falseHitCosine);
  rules.minVersine = static_cast<float>(2 * sine(minAngle / 2) * sine(minAngle / 2));
  rules.outlierDeviations = static_cast<float>(cone.outliers.deviations);
  rules.outlierSlack = static_cast<float>(cone.outliers.slack);
  rules.definition = cone.definition;
  return rules;
}

double PredictionKernel::value(std::span<const PointGroup> groups, std::span<const WeightedRange> ranges,
                               const VirtualCone& at, float medianLength) {
  size_t groupCount = 0;
  for (const WeightedRange& range : ranges) groupCount += range.groupCount;
  buffer_.resize(std::max(buffer_.size(), 3 * kPointGroupSize * groupCount));
  const KernelInput input{groups.data(), ranges, medianLength, buffer_.data()};
  return static_cast<double>(dispatch<Float16>(instructionSet_, [&]<typename Floats>() ASDFVK_ALWAYS_INLINE {
    if (rules_.definition == Definition::Paper) return predictedValue<Definition::Paper, Floats>(rules_, input, at);
    return predictedValue<Definition::Cgal, Floats>(rules_, input, at);
  }));
}

void PredictionKernel::weigh(const SeedGroup& seeds, const SeedWeighting& weighting, const VirtualCone& at,
                             float* weights) const {
  dispatch<Float16>(instructionSet_,
                    [&]<typename Floats>() ASDFVK_ALWAYS_INLINE { weighSeeds<Floats>(seeds, weighting, at, weights); });
}

}  // namespace asdfvk
