#pragma once

#include <span>
#include <vector>

#include "reprojection/reprojected_cone.h"

namespace asdfvk::test {

/// What a virtual cone's value may be: with the exact weighted median, and with any that is as near to it as the
/// bisection of ReprojectedCone comes.
struct TwinValue {
  double exact = 0;
  std::vector<double> admissible;  ///< `exact` among them.
};

/// ReprojectedCone::value() in double precision, ray by ray, with the exact arc cosine and a sorted median. Empty
/// `admissible` and NaN where no point lies in the cone.
[[nodiscard]] TwinValue plainTwin(const Cone& cone, const GatheredHits& hits, const VirtualCone& at,
                                  std::span<const float> coneWeights);

}  // namespace asdfvk::test
