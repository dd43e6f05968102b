#pragma once

#include <string>
#include <vector>

namespace asdfvk::bench {

/// Of repeated measurements: the median (mean of the middle two for an even count), the median absolute deviation from
/// it, and the extremes. All 0 for no samples.
struct Spread {
  double median = 0, deviation = 0, min = 0, max = 0;
};

[[nodiscard]] Spread spreadOf(std::vector<double> samples);

/// "0.123 ±0.004", median and median absolute deviation.
[[nodiscard]] std::string toText(const Spread& spread, int decimals);

}  // namespace asdfvk::bench
