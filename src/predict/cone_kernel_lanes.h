#pragma once

#include "core/lanes.h"
#include "predict/cone_kernel.h"
#include "shared/cone_rules.h"

/// ConeKernel for the instructions that the including file is compiled for.
namespace asdfvk {
inline namespace ASDFVK_LANE_NAMESPACE {

// The median is sought between mean - deviation and mean + deviation, where it must be, in passes that each leave a
// quarter of that; then between two of these bounds as if the lengths were spread evenly there.
constexpr int kMedianPassCount = 2;

struct FloatVec3 {
  float x, y, z;
};
ASDFVK_LANES FloatVec3 toFloat(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Sums over the points in a virtual cone.
struct ConeSums {
  LaneSum mass, off, squares;  ///< Off: mass times (length - typical length); squares: of that difference.
  LaneSum weight, weighted;    ///< Of the lengths that the seeds' own cones kept; weighted: by length.
};

/// The points in a virtual cone, in `count` entries each.
struct ConePoints {
  float* lengths;  ///< From the cone's origin; 0 where a point is not in the cone.
  float* masses;   ///< The solid angle that the point stands for, times its own cone's weight; likewise.
  float* weights;  ///< Mass over angle to the axis.
  size_t count;
};

/// sqrt(x) / arccos(1 - x) for 0 <= x <= 1, to a relative error of 3e-4.
ASDFVK_LANES Floats rootOverAngle(Floats x) { return 0.706948624f - x * (0.0564995318f + x * 0.0136869098f); }

ASDFVK_LANES void project(const ConeRules& rules, const ConeKernel::Seen& seen, const VirtualCone& at,
                          ConePoints& points, ConeSums& sums) {
  const FloatVec3 origin = toFloat(at.origin), normal = toFloat(at.normal);
  const Floats none = {};
  const Integers own = Integers{} + static_cast<int32_t>(at.face);
  const Floats leastChange = none + 1 / kLargestSpreadChange, greatestChange = none + kLargestSpreadChange;
  const Floats leastVersine = none + rules.leastVersine, leastCosine = none + rules.leastCosine,
               greatestFacing = none + rules.greatestFacing;
  for (size_t cone = 0; cone < seen.coneCount; ++cone) {
    const PointGroup* const begin = seen.groups + seen.cones[cone].firstGroup;
    const float coneWeight = seen.cones[cone].weight;
    for (const PointGroup* group = begin; group < begin + seen.cones[cone].groupCount; ++group) {
#pragma GCC unroll 4
      for (size_t lane = 0; lane < kLaneCount; lane += kLaneWidth) {
        const Floats x = loaded<Floats>(group->x + lane) - origin.x, y = loaded<Floats>(group->y + lane) - origin.y,
                     z = loaded<Floats>(group->z + lane) - origin.z;
        const Floats inverse = inverseRoot(x * x + y * y + z * z);
        const Floats length = (x * x + y * y + z * z) * inverse;
        const Floats cosine = (x * -normal.x + y * -normal.y + z * -normal.z) * inverse;
        const Floats facing = loaded<Floats>(group->nx + lane) * normal.x +
                              loaded<Floats>(group->ny + lane) * normal.y + loaded<Floats>(group->nz + lane) * normal.z;
        const Floats change =
            lesser(greater(loaded<Floats>(group->spread + lane) * (inverse * inverse), leastChange), greatestChange);
        const Floats versine = greater(1 - cosine, leastVersine);
        // False for a ray without a hit, whose numbers are NaN.
        const LaneMask counts = isAtMost(leastCosine, cosine) & isAtMost(facing, greatestFacing) &
                                isOther(loaded<Integers>(group->face + lane), own);
        const Floats mass = whereTrue(counts, coneWeight * change), kept = whereTrue(counts, length);
        const Floats weight = mass * (roughInverseRoot(versine) * rootOverAngle(versine));
        store(points.lengths + points.count + lane, kept);
        store(points.masses + points.count + lane, mass);
        store(points.weights + points.count + lane, weight);
        const Floats off = kept - seen.typicalLength, massOff = mass * off;
        sums.mass.add(lane, mass);
        sums.off.add(lane, massOff);
        sums.squares.add(lane, massOff * off);
        const Floats ownWeight = weight * loaded<Floats>(group->kept + lane);
        sums.weight.add(lane, ownWeight);
        sums.weighted.add(lane, ownWeight * kept);
      }
      points.count += kLaneCount;
    }
  }
}

/// Where a median lies: at two lengths, the mass up to there.
struct MedianBounds {
  float low, high, massToLow, massToHigh;
};

ASDFVK_LANES MedianBounds quarterOf(const ConePoints& points, const MedianBounds& bounds, float half) {
  const float quarter = 0.25f * (bounds.high - bounds.low);
  const Floats first = Floats{} + (bounds.low + quarter), second = Floats{} + (bounds.low + 2 * quarter),
               third = Floats{} + (bounds.low + 3 * quarter);
  LaneSum toFirst, toSecond, toThird;
  for (size_t i = 0; i < points.count; i += kLaneCount) {
#pragma GCC unroll 4
    for (size_t lane = 0; lane < kLaneCount; lane += kLaneWidth) {
      const Floats length = loaded<Floats>(points.lengths + i + lane), mass = loaded<Floats>(points.masses + i + lane);
      toFirst.add(lane, whereTrue(isAtMost(length, first), mass));
      toSecond.add(lane, whereTrue(isAtMost(length, second), mass));
      toThird.add(lane, whereTrue(isAtMost(length, third), mass));
    }
  }
  const float masses[3] = {toFirst.total(), toSecond.total(), toThird.total()};
  MedianBounds result = bounds;
  for (int i = 0; i < 3; ++i) {
    const float length = bounds.low + static_cast<float>(i + 1) * quarter;
    if (masses[i] >= half) {
      result.high = length;
      result.massToHigh = masses[i];
      break;
    }
    result.low = length;
    result.massToLow = masses[i];
  }
  return result;
}

ASDFVK_LANES float medianBetween(const ConePoints& points, MedianBounds bounds) {
  const float half = 0.5f * bounds.massToHigh;
  for (int pass = 0; pass < kMedianPassCount; ++pass) bounds = quarterOf(points, bounds, half);
  const float between = bounds.massToHigh - bounds.massToLow;
  const float share = between > 0 ? (half - bounds.massToLow) / between : 0.5f;
  return bounds.low + share * (bounds.high - bounds.low);
}

ASDFVK_LANES float coneValueInLanes(const ConeRules& rules, const ConeKernel::Seen& seen, const VirtualCone& at) {
  size_t room = 0;
  for (size_t cone = 0; cone < seen.coneCount; ++cone) room += seen.cones[cone].groupCount * kLaneCount;
  ConePoints points{seen.scratch, seen.scratch + room, seen.scratch + 2 * room, 0};
  ConeSums sums;
  project(rules, seen, at, points, sums);
  const float mass = sums.mass.total();
  if (!(mass > 0)) return __builtin_nanf("");
  const float meanOff = sums.off.total() / mass, variance = sums.squares.total() / mass - meanOff * meanOff;
  const float mean = seen.typicalLength + meanOff, deviation = variance > 0 ? __builtin_sqrtf(variance) : 0.0f;
  const float median = medianBetween(points, {mean - deviation, mean + deviation, 0, mass});
  const float bound = rules.outlierDeviations * deviation + kOutlierSlack * median;
  const Floats low = Floats{} + (median - bound), high = Floats{} + (median + bound);
  LaneSum weight, weighted;
  for (size_t i = 0; i < points.count; i += kLaneCount) {
#pragma GCC unroll 4
    for (size_t lane = 0; lane < kLaneCount; lane += kLaneWidth) {
      const Floats length = loaded<Floats>(points.lengths + i + lane);
      const Floats kept =
          whereTrue(isAtMost(low, length) & isAtMost(length, high), loaded<Floats>(points.weights + i + lane));
      weight.add(lane, kept);
      weighted.add(lane, kept * length);
    }
  }
  const float whole = kPooledShare * weight.total() + (1 - kPooledShare) * sums.weight.total();
  const float sum = kPooledShare * weighted.total() + (1 - kPooledShare) * sums.weighted.total();
  // Nothing is kept where rounding has left a deviation of next to nothing: then all lengths are about the same.
  return whole > 0 ? sum / whole : mean;
}

ASDFVK_LANES void weighInLanes(const SeedGroup& seeds, const SeedReach& reach, const VirtualCone& at, float* weights) {
  const FloatVec3 origin = toFloat(at.origin), normal = toFloat(at.normal);
#pragma GCC unroll 4
  for (size_t lane = 0; lane < kLaneCount; lane += kLaneWidth) {
    const Floats x = loaded<Floats>(seeds.x + lane) - origin.x, y = loaded<Floats>(seeds.y + lane) - origin.y,
                 z = loaded<Floats>(seeds.z + lane) - origin.z;
    const Floats cosine = loaded<Floats>(seeds.nx + lane) * normal.x + loaded<Floats>(seeds.ny + lane) * normal.y +
                          loaded<Floats>(seeds.nz + lane) * normal.z;
    const Floats u = greater(1 - cosine, Floats{});
    // The square of arccos(1 - u) by its series: off by 0.3 % at 90 degrees, and little counts beyond.
    const Floats turn = u * (2 + u * (1.0f / 3 + u * (4.0f / 45 + u * (1.0f / 35 + u * (16.0f / 1575)))));
    const Floats exponent = 0.5f * ((x * x + y * y + z * z) * reach.inverseSquare + turn * reach.turnFactor);
    store(weights + lane, greater(decay(lesser(exponent, Floats{} + 80.0f)), Floats{} + kLeastSeedWeight));
  }
}

/// The kernel of the instructions that this file is included for; each file that includes it has its own.
static constexpr ConeKernel kKernelInLanes{[](const ConeRules& rules, const ConeKernel::Seen& seen,
                                              const VirtualCone& at) { return coneValueInLanes(rules, seen, at); },
                                           [](const SeedGroup& seeds, const SeedReach& reach, const VirtualCone& at,
                                              float* weights) { weighInLanes(seeds, reach, at, weights); }};

}  // namespace ASDFVK_LANE_NAMESPACE
}  // namespace asdfvk
