#include "pipeline/seed_tracing.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdint>
#include <vector>

#include "seeds/component_seeds.h"

namespace asdfvk {
namespace {

// Below this size of the hierarchy, freed memory is kept for the next mesh: new pages cost more time than it holds.
constexpr size_t kMinReturnedByteCount = size_t{32} << 20;

/// Returns freed memory to the system: libraries free many small pieces, and later steps need large ones.
void returnFreedMemory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace

SeedTracing::SeedTracing(const Computation& computation, KeptTracers& tracers, Bvh* released)
    : computation_(computation),
      released_(released),
      tracer_(tracers.get(computation.options.cone, {.hits = computation.keepsHits()}, computation.clock)) {}

SeedTracing::~SeedTracing() {
  const auto scope = computation_.clock.time(setUpStage(computation_.backend));
  tracer_.reset();
  if (released_ == nullptr) return;
  const bool isLarge = released_->nodes.size() * sizeof(BvhNode) >= kMinReturnedByteCount;
  released_->nodes = {};
  if (isLarge) returnFreedMemory();
}

void SeedTracing::trace(std::span<const uint32_t> faces, TracedSeeds& traced, const RunControl& control) {
  std::vector<double> values(faces.size());
  const size_t earlierHitCount = traced.hits.size();
  traced.hits.resize(earlierHitCount + faces.size() * traced.hitsPerSeed);
  const TraceStatistics statistics =
      tracer_->tracer->trace(faces, {values, std::span(traced.hits).subspan(earlierHitCount)}, control);
  traced.statistics.rayCount += statistics.rayCount;
  traced.statistics.redoneConeCount += statistics.redoneConeCount;
  traced.faces.insert(traced.faces.end(), faces.begin(), faces.end());
  for (size_t i = 0; i < faces.size(); ++i) {
    traced.values[faces[i]] = values[i];
    traced.isSeed[faces[i]] = 1;
  }
}

void SeedTracing::traceComponentsWithoutValue(TracedSeeds& traced, const RunControl& control) {
  std::vector<uint32_t> untried;
  for (const uint32_t face : computation_.domain.traceableFaces)
    if (!traced.isSeed[face]) untried.push_back(face);
  if (untried.empty()) return;
  ComponentSeeds further(computation_.domain.componentOf, traced.values, untried, computation_.options.randomSeed);
  for (auto batch = further.next(traced.values); !batch.empty(); batch = further.next(traced.values))
    trace(batch, traced, control.withoutProgress());
}

}  // namespace asdfvk
