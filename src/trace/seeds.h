#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/free_memory.h"
#include "core/parallel.h"
#include "core/unset_vector.h"
#include "mesh/mesh.h"
#include "trace/cone_tracer.h"
#include "trace/seed_hits.h"

namespace asdfvk {

/// Why a node casts rays.
enum class SeedKind : uint8_t {
  Sampled,    ///< Selected by the sampler.
  HeldOut,    ///< A random sample, at which the error of an interpolation without it is measured.
  Extreme,    ///< See extremeSeeds().
  Component,  ///< The component had no value.
};

/// The seeds of a computation in the order in which they were traced. Entries are only appended; a step that leaves
/// seeds out uses nodesWithoutHeldOut(), or passes a condition to constraintsOf().
struct Seeds {
  std::vector<uint32_t> nodes;  ///< #S: nodes of the domain, each once.
  std::vector<SeedKind> kinds;  ///< #S
  std::vector<double> values;   ///< #S; NaN if no hit was valid.
  /// Sampling weight of each held-out seed, in their order; see HeldOutFaces.
  std::vector<double> heldOutWeights;
  size_t hitsPerSeed = 0;     ///< 0 if hits are not kept.
  UnsetVector<ConeHit> hits;  ///< #S x hitsPerSeed, see ConeResults::hits; empty if the hits are on the device.
  std::shared_ptr<DeviceHits> hitsOnDevice;  ///< Null if the hits are on the host.
  TraceStatistics statistics;

  [[nodiscard]] size_t size() const { return nodes.size(); }
  /// used: #S nodes; kNoFace leaves a seed out.
  [[nodiscard]] SeedHitsView hitsOf(std::span<const uint32_t> used) const { return {used, hits, hitsOnDevice.get()}; }
  void freeHits() {
    freeMemory(hits);
    hitsOnDevice.reset();
  }
  [[nodiscard]] bool isHeldOut(size_t seed) const { return kinds[seed] == SeedKind::HeldOut; }
};

/// #N: 1 for each seed.
[[nodiscard]] inline std::vector<uint8_t> seedFlags(const Seeds& seeds, size_t nodeCount) {
  std::vector<uint8_t> flags(nodeCount, 0);
  forEachInParallel(seeds.size(), [&](size_t seed) { flags[seeds.nodes[seed]] = 1; });
  return flags;
}

/// #N: the values of the seeds with holds(seed); NaN for other nodes.
template <typename Holds>
[[nodiscard]] std::vector<double> constraintsOf(const Seeds& seeds, size_t nodeCount, const Holds& holds) {
  std::vector<double> constraints(nodeCount, kNoValue);
  forEachInParallel(seeds.size(), [&](size_t seed) {
    if (holds(seed)) constraints[seeds.nodes[seed]] = seeds.values[seed];
  });
  return constraints;
}

/// #S: the nodes of the seeds without held-out seeds, for which it has kNoFace.
[[nodiscard]] inline std::vector<uint32_t> nodesWithoutHeldOut(const Seeds& seeds) {
  std::vector<uint32_t> nodes = seeds.nodes;
  for (size_t seed = 0; seed < nodes.size(); ++seed)
    if (seeds.isHeldOut(seed)) nodes[seed] = kNoFace;
  return nodes;
}

}  // namespace asdfvk
