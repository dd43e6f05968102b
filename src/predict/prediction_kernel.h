#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cone/cone.h"
#include "core/simd.h"
#include "core/vec3.h"
#include "shared/prediction_layout.h"

namespace asdfvk {

/// Number of points or seeds in a group: the lane count of the widest vector.
inline constexpr size_t kPointGroupSize = kLaneCount<Float16>;

/// Hit points of rays, in normalised units. All arrays have one entry per point.
struct alignas(64) PointGroup {
  float x[kPointGroupSize], y[kPointGroupSize], z[kPointGroupSize];     ///< NaN for a miss and for padding.
  float nx[kPointGroupSize], ny[kPointGroupSize], nz[kPointGroupSize];  ///< Unit normal of the hit face; finite.
  /// The area that the ray represents at the point, divided by the unit of Cone::solidAngles.
  float solidAngleRatio[kPointGroupSize];
  float isInlier[kPointGroupSize];  ///< 1 if the ray is not an outlier in the cone of its seed, else 0.
  uint32_t face[kPointGroupSize];   ///< The hit face, or kNoFace.
};

/// The hit points of one seed: a range of groups.
struct HitRange {
  uint32_t firstGroup = 0, groupCount = 0;
  float medianLength = 0;  ///< Median over the valid rays; 0 if there are none.
};

/// A seed that contributes to a prediction.
struct WeightedRange {
  uint32_t firstGroup = 0, groupCount = 0;
  float weight = 0;  ///< Above 0; multiplies the weight of each point of the range.
};

/// The cone of a face that casts no rays, in normalised units.
struct VirtualCone {
  Vec3d origin, normal;
  uint32_t face = 0;  ///< The face; if it has copies, their representative. Points on this face are ignored.
};

/// Seeds around a face, in normalised units. All arrays have one entry per seed.
struct SeedGroup {
  float x[kPointGroupSize] = {}, y[kPointGroupSize] = {}, z[kPointGroupSize] = {};     ///< Barycentres.
  float nx[kPointGroupSize] = {}, ny[kPointGroupSize] = {}, nz[kPointGroupSize] = {};  ///< Unit normals.
};

/// The weight of a seed is a Gaussian of its distance and of the angle between its normal and the normal of the face.
struct SeedWeighting {
  float inverseVariance = 0;       ///< 1 / square of the standard deviation of the distance.
  float inverseAngleVariance = 0;  ///< 1 / square of the standard deviation of the angle in radians.
};

/// Predicts the values of virtual cones from the hit points of seeds. Results have the same bits on every
/// instruction set. An object reuses its memory.
class PredictionKernel {
 public:
  /// Precondition: this machine has the instruction set.
  explicit PredictionKernel(const Cone& cone, InstructionSet instructionSet = widestInstructionSet());

  /// The shape diameter in normalised units; kNoValue if no point lies in the virtual cone. ranges: ranges of `groups`.
  /// medianLength: the approximate median distance of the points; sums are over differences from this number, which
  /// reduces rounding errors.
  [[nodiscard]] double value(std::span<const PointGroup> groups, std::span<const WeightedRange> ranges,
                             const VirtualCone& at, float medianLength);

  /// Computes the weights of the seeds. weights: kPointGroupSize entries; each becomes at least kMinSeedWeight.
  void weigh(const SeedGroup& seeds, const SeedWeighting& weighting, const VirtualCone& at, float* weights) const;

  /// The rules of the cone, in float32.
  struct Rules {
    float minCosine = 0;        ///< Least cosine of the angle between the axis and a point in the cone.
    float maxNormalCosine = 0;  ///< Cone::falseHitCosine.
    float minVersine = 0;       ///< 1 - cosine of the angle below which the weight of a point is constant.
    float outlierDeviations = 0, outlierSlack = 0;
    Definition definition = Definition::Paper;
  };
  [[nodiscard]] static Rules rulesOf(const Cone& cone);

 private:
  InstructionSet instructionSet_;
  Rules rules_;
  std::vector<float> buffer_;
};

}  // namespace asdfvk
