#include "spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asdfvk::bench {
namespace {

// Precondition: sorted and not empty.
double middleOf(const std::vector<double>& sorted) {
  const size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

}  // namespace

Spread spreadOf(std::vector<double> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  Spread spread{middleOf(samples), 0, samples.front(), samples.back()};
  for (double& sample : samples) sample = std::abs(sample - spread.median);
  std::sort(samples.begin(), samples.end());
  spread.deviation = middleOf(samples);
  return spread;
}

std::string toText(const Spread& spread, int decimals) {
  return fmt::format("{:.{}f} ±{:.{}f}", spread.median, decimals, spread.deviation, decimals);
}

}  // namespace asdfvk::bench
