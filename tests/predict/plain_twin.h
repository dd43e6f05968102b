#pragma once

#include <span>
#include <vector>

#include "predict/prediction_kernel.h"

namespace asdfvk::test {

/// What a virtual cone's value may be: with the exact weighted median, and with any that is as near to it as
/// PredictionKernel comes.
struct TwinValue {
  double exact = 0;
  std::vector<double> admissible;  ///< `exact` among them.
};

/// PredictionKernel::value() in double precision, ray by ray, with the exact arc cosine and a sorted median. Empty
/// `admissible` and NaN where no point lies in the cone.
[[nodiscard]] TwinValue plainTwin(const Cone& cone, const std::vector<PointGroup>& groups,
                                  std::span<const WeighedCone> cones, const VirtualCone& at);

}  // namespace asdfvk::test
