#include "pipeline/seed_tracing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/free_memory.h"
#include "core/parallel.h"
#include "seeds/component_seeds.h"

namespace asdfvk {

std::vector<uint32_t> untriedWithoutValue(const FaceDomain& domain, const TracedSeeds& traced) {
  std::vector<uint8_t> hasValue(domain.componentCount, 0);
  size_t withoutValueCount = domain.componentCount;
  for (size_t i = 0; i < traced.faces.size() && withoutValueCount > 0; ++i) {
    const uint32_t face = traced.faces[i];
    if (std::isfinite(traced.values[face]) && std::exchange(hasValue[domain.componentOf[face]], 1) == 0)
      --withoutValueCount;
  }
  if (withoutValueCount == 0) return {};
  return selectInParallel(domain.traceableFaces, [&](uint32_t face) {
    return !traced.isSeed[face] && hasValue[domain.componentOf[face]] == 0;
  });
}

SeedTracing::SeedTracing(const Computation& computation, KeptTracers& tracers, Bvh* released)
    : computation_(computation),
      released_(released),
      tracer_(tracers.get(computation.options.cone, {.hits = computation.keepsHits()}, computation.clock)) {}

SeedTracing::~SeedTracing() {
  const auto scope = computation_.clock.time(setUpStage(computation_.backend));
  tracer_.reset();
  if (released_ != nullptr) freeMemory(released_->nodes);
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
  forEachInParallel(faces.size(), [&](size_t i) {
    traced.values[faces[i]] = values[i];
    traced.isSeed[faces[i]] = 1;
  });
}

void SeedTracing::traceComponentsWithoutValue(TracedSeeds& traced, const RunControl& control) {
  const std::vector<uint32_t> untried = untriedWithoutValue(computation_.domain, traced);
  if (untried.empty()) return;
  ComponentSeeds further(computation_.domain.componentOf, traced.values, untried, computation_.options.randomSeed);
  for (auto batch = further.next(traced.values); !batch.empty(); batch = further.next(traced.values))
    trace(batch, traced, control.withoutProgress());
}

}  // namespace asdfvk
