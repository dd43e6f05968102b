#pragma once

#include <span>
#include <vector>

#include "predict/reprojection.h"

namespace asdfvk {

/// Where what is interpolated from some seeds may be expected to err: how far a face's prediction is from the value of
/// the seed of its cell, and that one from the values of the seeds around. Known before anything is interpolated.
/// prediction: from these seeds. seeds: #S, as it was given to reprojectHits(). values: #F, the seeds' are looked at.
/// Returns #F, above 0 and up to a factor; a face about which nothing is known is as the mean.
[[nodiscard]] std::vector<double> errorPattern(const Prediction& prediction, std::span<const uint32_t> seeds,
                                               std::span<const double> values);

}  // namespace asdfvk
