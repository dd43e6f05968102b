#pragma once

#include <span>

#include "core/unset_vector.h"
#include "predict/prediction.h"

namespace asdfvk {

/// A-priori indicator of the interpolation error of each face, up to a factor. The indicator is |p - v| + mean |v' -
/// v|. p: prediction of the face. v: value of the seed of its cell. v': values of the neighbouring seeds. prediction:
/// made from `seeds`. seeds, values: #S, in the order of the prediction. Returns #N, above 0; a node without an
/// indicator gets the mean.
[[nodiscard]] UnsetVector<double> errorIndicator(const Prediction& prediction, std::span<const uint32_t> seeds,
                                                 std::span<const double> values);

}  // namespace asdfvk
