#pragma once

#include <cmath>
#include <span>

#include "cone/cone.h"

namespace asdfvk {

struct LengthWindow {
  double median = 0, bound = 0;
  [[nodiscard]] bool keeps(double length) const { return std::abs(length - median) <= bound; }
};

/// The median of the lengths (for an even count the mean of the middle two). `bound` is the greatest difference from
/// the median that the rule allows. Precondition: 1 to kMaxRayCount lengths.
[[nodiscard]] LengthWindow keptWindow(std::span<const double> lengths, const OutlierRule& rule);

/// The shape diameter: the weighted mean of the lengths in keptWindow(). Returns kNoValue if there are no lengths, or
/// if the window contains no length (only possible if rule.deviations is below 1). lengths, weights: one entry per
/// valid ray of a cone, in the order of the cone.
[[nodiscard]] double coneValue(std::span<const double> lengths, std::span<const double> weights,
                               const OutlierRule& rule = {});

}  // namespace asdfvk
