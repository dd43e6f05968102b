#pragma once

#include <span>

namespace asdfvk::bench {

/// Differences between two fields over the range (max - min) of the first, as Table 1 of the ASDF paper gives them:
/// over all faces with a value in both, seeds included, whose error is 0.
struct ShareErrors {
  double average = 0, maximum = 0;
};

/// full, interpolated: #I, NaN for no value.
[[nodiscard]] ShareErrors errorsOverRange(std::span<const double> full, std::span<const double> interpolated);

}  // namespace asdfvk::bench
