#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cone/cone.h"
#include "core/instruction_set.h"
#include "core/lanes.h"
#include "core/vec3.h"
#include "reprojection/gathered_hits.h"

namespace asdfvk {

/// The cone of a face that casts no rays, in normalised units.
struct VirtualCone {
  Vec3d origin, normal;
  uint32_t face = 0;  ///< Or the one that stands for its copies: points on it do not count.
};

/// Computes the values of virtual cones from gathered hits; holds the room that it needs.
class ReprojectedCone {
 public:
  /// Precondition: this machine has the instruction set.
  explicit ReprojectedCone(const Cone& cone, InstructionSet instructionSet = widestInstructionSet());

  /// The shape diameter in normalised units, kNoValue when no point lies in the cone.
  /// coneWeights: per gathered cone, how much its rays count, above 0.
  [[nodiscard]] double value(const GatheredHits& hits, const VirtualCone& at, std::span<const float> coneWeights);

 private:
  double valueWithAvx2(const GatheredHits& hits, const VirtualCone& at, std::span<const float> coneWeights);
  double valueInLanes(const GatheredHits& hits, const VirtualCone& at, std::span<const float> coneWeights);
  void project(const GatheredHits& hits, const VirtualCone& at, std::span<const float> coneWeights);
  /// lows, highs: the least and the greatest length; half: of the whole mass.
  [[nodiscard]] float weightedMedian(const Lanes& lows, const Lanes& highs, float half) const;

  InstructionSet instructionSet_;
  float leastCosine_, greatestFacing_, leastAngle_, outlierDeviations_;
  // Per hit, as the virtual cone sees it; 0 where the hit is not in the cone.
  std::vector<float> lengths_;  ///< From the cone's origin.
  std::vector<float> masses_;   ///< The solid angle that the hit stands for, times its own cone's weight.
  std::vector<float> weights_;  ///< Mass over angle to the axis.
};

}  // namespace asdfvk
