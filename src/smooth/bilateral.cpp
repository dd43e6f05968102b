#include "smooth/bilateral.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

struct Rule {
  uint64_t minFaceCount;
  SmoothingOptions::Window window;
};
// Rows of face count and window, beginning with the finest meshes; docs/accuracy.md has the errors.
constexpr std::array<Rule, 3> kRules{{{90'000, {2, 2}}, {10'000, {2, 1}}, {0, {1, 1}}}};

/// exp(-ring^2 / (2 (ringCount / 2)^2))
double ringWeight(uint32_t ring, uint32_t ringCount) {
  const double ratio = 2.0 * ring / ringCount;
  return std::exp(-0.5 * ratio * ratio);
}

// Differences are divided by the largest difference, so that the squares neither overflow nor underflow in any unit.
double smoothedValue(const RingWindow& window, std::span<const double> values) {
  const double value = values[window.faces().front()];
  if (std::isnan(value)) return value;
  double maxDifference = 0;
  for (uint32_t face : window.faces())
    if (!std::isnan(values[face])) maxDifference = std::max(maxDifference, std::abs(values[face] - value));
  if (maxDifference == 0) return value;
  double squares = 0, count = 0;
  for (uint32_t face : window.faces()) {
    if (std::isnan(values[face])) continue;
    const double difference = (values[face] - value) / maxDifference;
    squares += difference * difference;
    ++count;
  }
  const double exponent = -0.5 * count / squares;  // -1 / (2 sigma^2)
  double weights = 0, sum = 0;
  for (uint32_t ring = 0; ring <= window.ringCount(); ++ring)
    for (uint32_t face : window.ring(ring)) {
      if (std::isnan(values[face])) continue;
      const double difference = (values[face] - value) / maxDifference;
      const double weight = ringWeight(ring, window.ringCount()) * std::exp(exponent * difference * difference);
      weights += weight;
      sum += weight * difference;
    }
  return value + maxDifference * (sum / weights);
}

}  // namespace

SmoothingOptions::Window smoothingWindowFor(uint64_t faceCount) {
  return std::find_if(kRules.begin(), kRules.end(), [&](const Rule& rule) { return faceCount >= rule.minFaceCount; })
      ->window;
}

std::vector<double> smoothBilaterally(const DualGraph& graph, std::span<const double> values,
                                      const SmoothingOptions::Window& window, const RunControl& stopOnly) {
  if (window.rings < 1 || window.rings > kMaxBilateralWindow)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("a smoothing window of {} rings is out of range (1 to {})",
                                                         window.rings, kMaxBilateralWindow));
  ASDFVK_CHECK_OP(values.size(), ==, size_t{graph.faceCount()});
  std::vector<double> from(values.begin(), values.end()), to(values.size());
  for (uint32_t pass = 0; pass < window.passes; ++pass) {
    constexpr size_t kGrain = 1024;
    forEachRange(graph.faceCount(), kGrain, [&](size_t begin, size_t end) {
      if (stopOnly.stop.stop_requested()) return;
      RingWindow faces;
      for (auto face = static_cast<uint32_t>(begin); face < end; ++face) {
        faces.gather(graph, face, window.rings);
        to[face] = smoothedValue(faces, from);
      }
    });
    stopOnly.checkpoint(0);
    std::swap(from, to);
  }
  return from;
}

void RingWindow::gather(const DualGraph& graph, uint32_t face, uint32_t ringCount) {
  ASDFVK_CHECK_OP(ringCount, >=, 1u);
  ASDFVK_CHECK_OP(ringCount, <=, kMaxBilateralWindow);
  ringCount_ = ringCount;
  faces_[0] = face;
  ringEnds_[0] = 1;
  uint32_t count = 1, arcsLeft = kMaxWindowArcCount;
  for (uint32_t ring = 1; ring <= ringCount; ++ring) {
    // A neighbour of a face in ring r - 1 is in ring r - 2, r - 1 or r.
    const uint32_t searchBegin = ring < 2 ? 0 : ringBegin(ring - 2);
    const uint32_t parentEnd = count;
    for (uint32_t parent = ringBegin(ring - 1); parent < parentEnd; ++parent)
      for (uint32_t neighbour : graph.neighboursOf(faces_[parent])) {
        if (arcsLeft == 0 || count == kMaxWindowFaceCount) break;
        --arcsLeft;
        const auto end = faces_.begin() + count;
        if (std::find(faces_.begin() + searchBegin, end, neighbour) == end) faces_[count++] = neighbour;
      }
    ringEnds_[ring] = count;
  }
}

}  // namespace asdfvk
