#pragma once

#include <span>
#include <vector>

#include "predict/prediction.h"

namespace asdfvk {

/// A-priori indicator of the interpolation error of each face, up to a factor. It is |p - v| + mean |v' - v|, with the
/// prediction p of the face, the value v of the seed of its cell, and the values v' of the neighbouring seeds.
/// prediction: made from `seeds`. seeds: #S, in the order of the prediction. values: #F; only the values of the seeds
/// are read. Returns #F, above 0; a face without an indicator gets the mean.
[[nodiscard]] std::vector<double> errorIndicator(const Prediction& prediction, std::span<const uint32_t> seeds,
                                                 std::span<const double> values);

}  // namespace asdfvk
