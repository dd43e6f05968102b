#pragma once

#include <span>
#include <vector>

#include "cone/cone.h"
#include "core/instruction_set.h"
#include "predict/cone_kernel.h"

namespace asdfvk {

/// Precondition: this machine has the instruction set.
[[nodiscard]] const ConeKernel& coneKernel(InstructionSet instructionSet = widestInstructionSet());

/// Computes the values of virtual cones from the points of the cones around; holds the room that it needs.
class ReprojectedCone {
 public:
  explicit ReprojectedCone(const Cone& cone, const ConeKernel& kernel = coneKernel());

  /// The shape diameter in normalised units, kNoValue when no point lies in the cone.
  /// cones: of `groups`. typicalLength: see ConeKernel.
  [[nodiscard]] double value(const std::vector<PointGroup>& groups, std::span<const WeighedCone> cones,
                             const VirtualCone& at, float typicalLength);

 private:
  const ConeKernel& kernel_;
  ConeRules rules_;
  std::vector<float> scratch_;
};

}  // namespace asdfvk
