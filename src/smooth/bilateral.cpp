#include "smooth/bilateral.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "smooth/ring_window.h"

namespace asdfvk {
namespace {

struct Rule {
  uint64_t minFaceCount;
  SmoothingOptions::Window options;
};
// Finest first; docs/accuracy.md has the errors behind it.
constexpr std::array<Rule, 3> kRules{{{90'000, {2, 2}}, {10'000, {2, 1}}, {0, {1, 1}}}};

/// exp(-ring^2 / (2 (window / 2)^2))
double ringWeight(uint32_t ring, uint32_t window) {
  const double ratio = 2.0 * ring / window;
  return std::exp(-0.5 * ratio * ratio);
}

// Differences are divided by their largest, so that no unit makes their squares overflow or vanish.
double smoothedValue(const RingWindow& window, std::span<const double> values) {
  const double value = values[window.faces().front()];
  if (std::isnan(value)) return value;
  double largest = 0;
  for (uint32_t face : window.faces())
    if (!std::isnan(values[face])) largest = std::max(largest, std::abs(values[face] - value));
  if (largest == 0) return value;
  double squares = 0, count = 0;
  for (uint32_t face : window.faces()) {
    if (std::isnan(values[face])) continue;
    const double difference = (values[face] - value) / largest;
    squares += difference * difference;
    ++count;
  }
  const double exponent = -0.5 * count / squares;  // -1 / (2 sigma^2)
  double weights = 0, sum = 0;
  for (uint32_t ring = 0; ring <= window.ringCount(); ++ring)
    for (uint32_t face : window.ring(ring)) {
      if (std::isnan(values[face])) continue;
      const double difference = (values[face] - value) / largest;
      const double weight = ringWeight(ring, window.ringCount()) * std::exp(exponent * difference * difference);
      weights += weight;
      sum += weight * difference;
    }
  return value + largest * (sum / weights);
}

}  // namespace

SmoothingOptions::Window smoothingWindowFor(uint64_t faceCount) {
  return std::find_if(kRules.begin(), kRules.end(), [&](const Rule& rule) { return faceCount >= rule.minFaceCount; })
      ->options;
}

void requireValid(const SmoothingOptions::Window& options) {
  if (options.rings < 1 || options.rings > kMaxBilateralWindow)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("a smoothing window of {} rings is out of range; use 1 to {}",
                                                         options.rings, kMaxBilateralWindow));
}

std::vector<double> smoothBilaterally(const DualGraph& graph, std::span<const double> values,
                                      const SmoothingOptions::Window& options) {
  requireValid(options);
  ASDFVK_CHECK_OP(values.size(), ==, size_t{graph.faceCount()});
  std::vector<double> from(values.begin(), values.end()), to(values.size());
  for (uint32_t pass = 0; pass < options.passes; ++pass) {
    constexpr uint32_t kGrain = 1024;
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, graph.faceCount(), kGrain),
                      [&](const tbb::blocked_range<uint32_t>& range) {
                        RingWindow window;
                        for (uint32_t face = range.begin(); face < range.end(); ++face) {
                          window.gather(graph, face, options.rings);
                          to[face] = smoothedValue(window, from);
                        }
                      });
    std::swap(from, to);
  }
  return from;
}

}  // namespace asdfvk
