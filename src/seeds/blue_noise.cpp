#include "seeds/blue_noise.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/random.h"
#include "seeds/dart_throwing.h"
#include "seeds/disk_radius.h"
#include "seeds/surface_distances.h"

namespace asdfvk {
namespace {

// The start radius is raised where the estimate was too small, so many times by so much and then to infinity, where it
// can no longer be at fault: then there are fewer seeds than components.
constexpr int kMaxRaiseCount = 4;
constexpr float kRaise = 1.5f;

std::vector<uint32_t> blueNoise(const SeedDomain& domain, std::span<const float> lengths, uint64_t count,
                                std::span<const uint32_t> existing, uint64_t randomSeed) {
  std::vector<uint32_t> waiting = unchosenCandidates(domain, existing);
  if (count >= waiting.size()) return waiting;
  if (count == 0) return {};
  Random random(randomSeed);
  random.shuffle(std::span<uint32_t>(waiting));
  // The estimate is somewhat off either way. Too large a radius costs time only, too small a one the evenness.
  float startRadius = 1.25f * estimateDiskRadius(domain.graph, lengths, waiting, count, random.next());
  SurfaceDistances distances(domain.graph, lengths);
  for (int raiseCount = 0;; ++raiseCount) {
    distances.add(existing, startRadius);
    ThrownDarts darts = throwDarts(waiting, count, startRadius, distances);
    if (!darts.leaveGaps || startRadius == SurfaceDistances::kUnreached) {
      std::sort(darts.faces.begin(), darts.faces.end());
      return std::move(darts.faces);
    }
    startRadius = raiseCount < kMaxRaiseCount ? kRaise * startRadius : SurfaceDistances::kUnreached;
    distances.clear();
  }
}

// Seeds near each other are whole hops apart on a smooth mesh, so that some densities would come out as the same
// distance and others as more than theirs. A random stretch of each arc by up to this share evens that out.
constexpr double kJitter = 0.25;

double jitterOf(uint32_t face, uint32_t neighbour) {
  const auto [low, high] = std::minmax(face, neighbour);
  return 1 + kJitter * (2 * Random(uint64_t{low} << 32 | high).real() - 1);
}

// Where the density is the mean of all, an arc keeps its length but for the jitter.
void stretch(std::vector<float>& lengths, const DualGraph& graph, std::span<const double> density) {
  double mean = 0;
  for (double d : density) {
    ASDFVK_CHECK(d > 0 && std::isfinite(d));
    mean += d / static_cast<double>(density.size());
  }
  tbb::parallel_for(uint32_t{0}, graph.faceCount(), [&](uint32_t face) {
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
      const uint32_t neighbour = graph.neighbours[arc];
      const double relative = 0.5 * (density[face] / mean + density[neighbour] / mean);
      const double length = lengths[arc] * std::sqrt(relative) * jitterOf(face, neighbour);
      lengths[arc] = static_cast<float>(std::clamp<double>(length, kShortestArc, kLongestArc));
    }
  });
}

}  // namespace

std::vector<uint32_t> blueNoiseSeeds(const SeedDomain& domain, SurfaceMetric metric, uint64_t count,
                                     std::span<const uint32_t> existing, uint64_t randomSeed) {
  return blueNoise(domain, arcLengths(domain.graph, domain.geometry, metric), count, existing, randomSeed);
}

std::vector<uint32_t> weightedBlueNoiseSeeds(const SeedDomain& domain, SurfaceMetric metric,
                                             std::span<const double> density, uint64_t count,
                                             std::span<const uint32_t> existing, uint64_t randomSeed) {
  ASDFVK_CHECK_OP(density.size(), ==, domain.graph.faceCount());
  std::vector<float> lengths = arcLengths(domain.graph, domain.geometry, metric);
  stretch(lengths, domain.graph, density);
  return blueNoise(domain, lengths, count, existing, randomSeed);
}

}  // namespace asdfvk
