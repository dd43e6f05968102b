#include "share_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/check.h"

namespace asdfvk::bench {

ShareErrors errorsOverRange(std::span<const double> full, std::span<const double> interpolated) {
  ASDFVK_CHECK_OP(full.size(), ==, interpolated.size());
  double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0;
  size_t count = 0;
  ShareErrors errors;
  for (size_t i = 0; i < full.size(); ++i) {
    if (std::isnan(full[i])) continue;
    low = std::min(low, full[i]);
    high = std::max(high, full[i]);
    if (std::isnan(interpolated[i])) continue;
    const double error = std::abs(interpolated[i] - full[i]);
    sum += error;
    errors.maximum = std::max(errors.maximum, error);
    ++count;
  }
  if (!(high > low)) return {};
  errors.average = sum / static_cast<double>(count) / (high - low);
  errors.maximum /= high - low;
  return errors;
}

}  // namespace asdfvk::bench
