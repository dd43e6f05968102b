#include "seeds/blue_noise.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/random.h"
#include "seeds/dart_throwing.h"
#include "seeds/disk_radius.h"
#include "seeds/surface_distances.h"

namespace asdfvk {
namespace {

std::vector<uint32_t> blueNoise(const SeedDomain& domain, std::span<const float> lengths, uint64_t count,
                                std::span<const uint32_t> existing, uint64_t randomSeed) {
  std::vector<uint32_t> waiting = unchosenCandidates(domain, existing);
  if (count >= waiting.size()) return waiting;
  if (count == 0) return {};
  Random random(randomSeed);
  random.shuffle(std::span<uint32_t>(waiting));
  DartRadii radii;
  radii.start = 1.25f * estimateDiskRadius(domain.graph, lengths, waiting, count, random.next());
  SurfaceDistances distances(domain.graph, lengths);
  for (int attempt = 0;; ++attempt) {
    distances.add(existing, radii.start);
    ThrownDarts darts = throwDarts(waiting, count, radii, distances);
    if (!darts.endedAtStart || attempt == 8) {
      std::sort(darts.faces.begin(), darts.faces.end());
      return std::move(darts.faces);
    }
    radii.start *= 1.5f;
    distances.clear();
  }
}

// At the mean of the densities of its faces an arc keeps its length.
void stretch(std::vector<float>& lengths, const DualGraph& graph, std::span<const double> density) {
  double sum = 0;
  for (double d : density) {
    ASDFVK_CHECK(d > 0 && std::isfinite(d));
    sum += d / static_cast<double>(density.size());
  }
  for (uint32_t face = 0; face < graph.faceCount(); ++face) {
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
      const double mean = 0.5 * (density[face] / sum + density[graph.neighbours[arc]] / sum);
      lengths[arc] = std::clamp(lengths[arc] * static_cast<float>(std::sqrt(mean)), kShortestArc, kLongestArc);
    }
  }
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
