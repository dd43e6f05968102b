#pragma once

#include <cmath>
#include <cstring>
#include <vector>

#include "support/bits.h"
#include "trace/vk/vulkan_tracer.h"
#include "traced_mesh.h"

namespace asdfvk {

/// The results of a tracer for all seed faces of a mesh, in the order of TracedMesh::seedFaces().
struct TraceResults {
  std::vector<double> values;
  std::vector<ConeHit> hits;  ///< Empty unless requested.
  TraceStatistics statistics;
};

enum class Wanted { Values, ValuesAndHits };

inline TraceResults traceAll(ConeTracer& tracer, const TracedMesh& traced, size_t rayCount, Wanted wanted,
                             const RunControl& control = {}) {
  const std::vector<uint32_t> seeds = traced.seedFaces();
  TraceResults results{std::vector<double>(seeds.size()), {}, {}};
  if (wanted == Wanted::ValuesAndHits) results.hits.resize(seeds.size() * rayCount, {-1, 0});
  results.statistics = tracer.trace(seeds, {results.values, results.hits}, control);
  return results;
}

inline TraceResults traceByReference(const TracedMesh& traced, const ConeOptions& options, Wanted wanted) {
  const Cone cone = makeCone(options);
  return traceAll(*makeReferenceTracer(traced.scene(), cone), traced, options.rayCount, wanted);
}

inline TraceResults traceByKernel(const VulkanConeKernel& kernel, const TracedMesh& traced, const ConeOptions& options,
                                  Wanted wanted, const RunControl& control = {}) {
  const Cone cone = makeCone(options);
  return traceAll(*makeVulkanTracer(kernel, traced.scene(), cone), traced, options.rayCount, wanted, control);
}

/// Faces that differ by more than 1e-4 of the diagonal, or that have a value on one side only.
inline uint64_t differingCount(const std::vector<double>& a, const std::vector<double>& b, double diagonal) {
  uint64_t count = a.size() == b.size() ? 0 : std::max(a.size(), b.size());
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const bool isSame = std::isnan(a[i]) || std::isnan(b[i]) ? std::isnan(a[i]) == std::isnan(b[i])
                                                             : std::abs(a[i] - b[i]) <= 1e-4 * diagonal;
    count += !isSame;
  }
  return count;
}

}  // namespace asdfvk
