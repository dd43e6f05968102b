#include "estimate/error_indicator.h"

#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "mesh/mesh.h"

namespace asdfvk {
namespace {

// Of the mean: what is expected of a face where all agree.
constexpr double kLeastExpectation = 0.5;

/// #S: how far the seeds around are from each in value, on average; NaN for a seed without a value.
std::vector<double> spreadAround(const NearestCells& nearest, std::span<const uint32_t> seeds,
                                 std::span<const double> values) {
  std::vector<double> spread(seeds.size(), kNoValue);
  forEachInParallel(seeds.size(), [&](uint32_t cell) {
    if (seeds[cell] == kNoFace) return;
    const double own = values[seeds[cell]];
    double sum = 0;
    size_t count = 0;
    for (const uint32_t other : nearest.of(cell))
      if (const double difference = std::abs(values[seeds[other]] - own); other != cell && !std::isnan(difference)) {
        sum += difference;
        ++count;
      }
    if (!std::isnan(own)) spread[cell] = count > 0 ? sum / static_cast<double>(count) : 0;
  });
  return spread;
}

/// Adds what is expected of every face, and gives faces without an entry the mean.
void raise(std::vector<double>& pattern) {
  double sum = 0;
  size_t count = 0;
  for (const double entry : pattern)
    if (!std::isnan(entry)) {
      sum += entry;
      ++count;
    }
  const double mean = count > 0 ? sum / static_cast<double>(count) : 0, least = mean > 0 ? kLeastExpectation * mean : 1;
  for (double& entry : pattern) entry = (std::isnan(entry) ? mean : entry) + least;
}

}  // namespace

std::vector<double> errorPattern(const Prediction& prediction, std::span<const uint32_t> seeds,
                                 std::span<const double> values) {
  ASDFVK_CHECK_OP(prediction.nearest.cellCount(), ==, seeds.size());
  const std::vector<double> spread = spreadAround(prediction.nearest, seeds, values);
  std::vector<double> pattern(prediction.values.size(), kNoValue);
  forEachInParallel(pattern.size(), [&](uint32_t face) {
    const uint32_t cell = prediction.cellOf[face];
    if (cell != kNoCell) pattern[face] = std::abs(prediction.values[face] - values[seeds[cell]]) + spread[cell];
  });
  raise(pattern);
  return pattern;
}

}  // namespace asdfvk
