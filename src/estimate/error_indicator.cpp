#include "estimate/error_indicator.h"

#include <cmath>

#include "core/check.h"
#include "core/ordered_sum.h"
#include "core/parallel.h"
#include "mesh/mesh.h"

namespace asdfvk {
namespace {

// Number that is added to each entry, in units of the mean. If the seeds of a face agree exactly, this number is its
// whole indicator.
constexpr double kFloor = 0.5;

/// #S: mean absolute difference between the value of a seed and the values of its neighbours; NaN for a seed without a
/// value.
std::vector<double> neighbourDeviation(const NearestCells& nearest, std::span<const uint32_t> seeds,
                                       std::span<const double> values) {
  std::vector<double> deviation(seeds.size(), kNoValue);
  forEachInParallel(seeds.size(), [&](uint32_t cell) {
    if (seeds[cell] == kNoFace) return;
    const double own = values[cell];
    double sum = 0;
    size_t count = 0;
    for (const uint32_t other : nearest.of(cell))
      if (const double difference = std::abs(values[other] - own); other != cell && !std::isnan(difference)) {
        sum += difference;
        ++count;
      }
    if (!std::isnan(own)) deviation[cell] = count > 0 ? sum / static_cast<double>(count) : 0;
  });
  return deviation;
}

/// Adds the floor to each entry; faces without an entry receive the mean.
void addFloor(std::span<double> indicator) {
  const uint64_t count = countInParallel(indicator.size(), [&](uint32_t face) { return !std::isnan(indicator[face]); });
  const double sum =
      orderedSum(indicator.size(), [&](size_t face) { return std::isnan(indicator[face]) ? 0 : indicator[face]; });
  const double mean = count > 0 ? sum / static_cast<double>(count) : 0, floor = mean > 0 ? kFloor * mean : 1;
  forEachInParallel(indicator.size(), [&](uint32_t face) {
    double& entry = indicator[face];
    entry = (std::isnan(entry) ? mean : entry) + floor;
  });
}

}  // namespace

UnsetVector<double> errorIndicator(const Prediction& prediction, std::span<const uint32_t> seeds,
                                   std::span<const double> values) {
  ASDFVK_CHECK_OP(prediction.nearest.cellCount(), ==, seeds.size());
  const std::vector<double> deviation = neighbourDeviation(prediction.nearest, seeds, values);
  UnsetVector<double> indicator(prediction.values.size());
  forEachInParallel(indicator.size(), [&](uint32_t node) {
    const uint32_t cell = prediction.cellOf[node];
    indicator[node] = cell != kNoCell ? std::abs(prediction.values[node] - values[cell]) + deviation[cell] : kNoValue;
  });
  addFloor(indicator);
  return indicator;
}

}  // namespace asdfvk
