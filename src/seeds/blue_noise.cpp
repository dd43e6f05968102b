#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "core/random.h"
#include "seeds/dart_throwing.h"
#include "seeds/samplers.h"
#include "seeds/surface_distances.h"

namespace asdfvk {
namespace {

/// Estimates the radius at which about `count` Poisson disks fill the candidates; no centre is in the disk of another
/// centre. In the plane, a disk of this radius contains 2.2 times as many faces as there are faces per centre. Reason:
/// maximal random packings of disks of half the radius cover 0.55 of the plane. For random candidates, the function
/// measures the radius that contains this number of faces. The estimate is the root mean square of these radii.
/// Precondition: at least one candidate, count at least 1. Takes about one pass over the graph.
float estimateDiskRadius(const DualGraph& graph, std::span<const float> arcLengths,
                         std::span<const uint32_t> candidates, uint64_t count, uint64_t randomSeed) {
  ASDFVK_CHECK(!candidates.empty());
  ASDFVK_CHECK_OP(count, >, 0u);
  constexpr double kFacesInDiskPerFacePerCentre = 2.2;
  constexpr double kMaxSampleCount = 256;
  const double candidateCount = static_cast<double>(candidates.size());
  const double wantedFaceCount = 1 + kFacesInDiskPerFacePerCentre * candidateCount / static_cast<double>(count);
  const double sampleCount = std::floor(std::clamp(candidateCount / wantedFaceCount, 1.0, kMaxSampleCount));
  Random random(randomSeed);
  SurfaceBall ball(graph, arcLengths);
  double squaredRadii = 0;
  for (int sample = 0; sample < sampleCount; ++sample) {
    ball.startAt(candidates[random.index(static_cast<uint32_t>(candidates.size()))]);
    SurfaceBall::Member member;
    double faceCount = 0;
    while (faceCount < wantedFaceCount && ball.next(member)) ++faceCount;
    // If the component is smaller than the disk, this factor extrapolates.
    squaredRadii += double{member.distance} * double{member.distance} * wantedFaceCount / faceCount;
  }
  return std::max(kMinArcLength, static_cast<float>(std::sqrt(squaredRadii / sampleCount)));
}

// A start radius that was too small is multiplied by kRadiusGrowth. After kMaxGrowthCount multiplications the radius is
// set to infinity. If there are fewer seeds than components, no finite radius is large enough.
constexpr int kMaxGrowthCount = 4;
constexpr float kRadiusGrowth = 1.5f;

/// Poisson-disk sampling of a graph. waiting: candidates that are not in `existing`, more than `count`. count: at least
/// 1. All seeds and candidates are nodes of the graph. Returns the new seeds, ascending.
std::vector<uint32_t> throwAtGraph(const DualGraph& graph, std::span<const float> lengths,
                                   std::vector<uint32_t> waiting, uint64_t count, std::span<const uint32_t> existing,
                                   uint64_t randomSeed, const RunControl& stopOnly) {
  Random random(randomSeed);
  random.shuffle(std::span<uint32_t>(waiting));
  // A start radius that is too large only costs time; a start radius that is too small leaves gaps.
  float startRadius = 1.25f * estimateDiskRadius(graph, lengths, waiting, count, random.next());
  SurfaceDistances distances(graph, lengths);
  for (int growthCount = 0;; ++growthCount) {
    distances.add(existing, startRadius);
    ThrownDarts darts = throwDarts(waiting, count, startRadius, distances, stopOnly);
    if (!darts.leaveGaps || startRadius == SurfaceDistances::kUnreached) {
      sortInParallel(darts.faces.begin(), darts.faces.end());
      return std::move(darts.faces);
    }
    startRadius = growthCount < kMaxGrowthCount ? kRadiusGrowth * startRadius : SurfaceDistances::kUnreached;
    distances.clear();
  }
}

std::vector<uint32_t> blueNoise(const SeedDomain& domain, std::span<const float> lengths, uint64_t count,
                                std::span<const uint32_t> existing, uint64_t randomSeed) {
  std::vector<uint32_t> waiting = remainingCandidates(domain, existing);
  if (count >= waiting.size()) return waiting;
  if (count == 0) return {};
  return throwAtGraph(domain.graph, lengths, std::move(waiting), count, existing, randomSeed, domain.stopOnly);
}

// On a smooth mesh, the distances between close seeds are nearly integers. Without a change of the lengths, different
// densities would give the same spacing. Therefore each arc is stretched at random by up to this share.
constexpr double kJitter = 0.25;

double jitterOf(uint32_t face, uint32_t neighbour) {
  const auto [low, high] = std::minmax(face, neighbour);
  return 1 + kJitter * (2 * Random(uint64_t{low} << 32 | high).real() - 1);
}

// Arcs at faces of average density keep their length, except for the jitter.
void stretch(std::span<float> lengths, const DualGraph& graph, std::span<const double> density) {
  double mean = 0;
  for (double d : density) {
    ASDFVK_CHECK(d > 0 && std::isfinite(d));
    mean += d / static_cast<double>(density.size());
  }
  forEachInParallel(graph.faceCount(), [&](uint32_t face) {
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
      const uint32_t neighbour = graph.neighbours[arc];
      const double relative = 0.5 * (density[face] / mean + density[neighbour] / mean);
      const double length = lengths[arc] * std::sqrt(relative) * jitterOf(face, neighbour);
      lengths[arc] = static_cast<float>(std::clamp<double>(length, kMinArcLength, kMaxArcLength));
    }
  });
}

}  // namespace

std::vector<uint32_t> blueNoiseSeeds(const SeedDomain& domain, uint64_t count, std::span<const uint32_t> existing,
                                     uint64_t randomSeed) {
  return blueNoise(domain, arcLengths(domain.arcAngles.get()), count, existing, randomSeed);
}

std::vector<uint32_t> weightedBlueNoiseSeeds(const SeedDomain& domain, std::span<const double> density, uint64_t count,
                                             std::span<const uint32_t> existing, uint64_t randomSeed) {
  ASDFVK_CHECK_OP(density.size(), ==, domain.graph.faceCount());
  UnsetVector<float> lengths = arcLengths(domain.arcAngles.get());
  stretch(lengths, domain.graph, density);
  return blueNoise(domain, lengths, count, existing, randomSeed);
}

}  // namespace asdfvk
