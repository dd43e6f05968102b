#include "pipeline/seed_tracing.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"
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

SeedTracing::SeedTracing(const Computation& computation, SceneTracers& tracers, Bvh* released)
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
  reserveStored(traced, faces.size());
  std::vector<double> values(faces.size());
  const size_t earlierHitCount = traced.hits.size(), hitCount = faces.size() * computation_.cone.directions.size();
  const bool isKept = computation_.keepsHits() && hitStore_ == nullptr;
  if (isKept) traced.hits.resize(earlierHitCount + hitCount);
  const std::span<ConeHit> hits = isKept ? std::span(traced.hits).subspan(earlierHitCount) : std::span<ConeHit>{};
  const TraceStatistics statistics = tracer_->tracer->trace(faces, {values, hits, hitStore_}, control);
  traced.statistics.rayCount += statistics.rayCount;
  traced.statistics.redoneConeCount += statistics.redoneConeCount;
  if (statistics.deviceSeconds)
    traced.statistics.deviceSeconds = traced.statistics.deviceSeconds.value_or(0) + *statistics.deviceSeconds;
  traced.faces.insert(traced.faces.end(), faces.begin(), faces.end());
  for (size_t i = 0; i < faces.size(); ++i) {
    traced.values[faces[i]] = values[i];
    traced.isSeed[faces[i]] = 1;
  }
}

void SeedTracing::reserve(TracedSeeds& traced, size_t furtherCount) {
  traced.faces.reserve(traced.faces.size() + furtherCount);
  reserveStored(traced, furtherCount);
  if (computation_.keepsHits() && hitStore_ == nullptr)
    traced.hits.reserve(traced.hits.size() + furtherCount * computation_.cone.directions.size());
}

void SeedTracing::reserveStored(TracedSeeds& traced, size_t furtherCount) {
  if (hitStore_ == nullptr) return;
  try {
    hitStore_->reserve(furtherCount);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Device) throw;
    traced.hits = hitStore_->download();
    std::exchange(hitStore_, nullptr)->release();
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
