#pragma once

#include <span>
#include <vector>

#include "predict/prediction_kernel.h"

namespace asdfvk::test {

/// The value of a virtual cone with the exact weighted median, and its values with every median within the tolerance of
/// PredictionKernel.
struct TwinValue {
  double exact = 0;
  std::vector<double> admissible;  ///< Includes `exact`.
};

/// PredictionKernel::value() in double precision, point by point, with the exact arc cosine and a sorted median. Where
/// no point lies in the cone: NaN, and `admissible` is empty.
[[nodiscard]] TwinValue plainTwin(const Cone& cone, const std::vector<PointGroup>& groups,
                                  std::span<const WeightedRange> ranges, const VirtualCone& at);

}  // namespace asdfvk::test
