#include "pipeline/seed_tracing.h"

#include "seeds/component_seeds.h"

namespace asdfvk {

void TracedSeeds::append(const TracedSeeds& other) {
  for (const uint32_t face : other.faces) {
    values[face] = other.values[face];
    isSeed[face] = 1;
  }
  faces.insert(faces.end(), other.faces.begin(), other.faces.end());
  hits.reserve(hits.size() + other.hits.size());  // No more, as it would be by itself: there may be many.
  hits.insert(hits.end(), other.hits.begin(), other.hits.end());
  statistics.rayCount += other.statistics.rayCount;
  statistics.redoneConeCount += other.statistics.redoneConeCount;
}

void SeedTracing::trace(std::span<const uint32_t> faces, TracedSeeds& traced, const RunControl& control) {
  std::vector<double> values(faces.size());
  const size_t hitCount = traced.hits.size();
  if (keepsHits_) traced.hits.resize(hitCount + faces.size() * rayCount_);
  const TraceStatistics statistics = tracer_.trace(faces, {values, std::span(traced.hits).subspan(hitCount)}, control);
  traced.statistics.rayCount += statistics.rayCount;
  traced.statistics.redoneConeCount += statistics.redoneConeCount;
  traced.faces.insert(traced.faces.end(), faces.begin(), faces.end());
  for (size_t i = 0; i < faces.size(); ++i) {
    traced.values[faces[i]] = values[i];
    traced.isSeed[faces[i]] = 1;
  }
}

void SeedTracing::traceComponentsWithoutValue(TracedSeeds& traced, std::span<const uint8_t> taken, uint64_t randomSeed,
                                              const RunControl& control) {
  std::vector<uint32_t> untried;
  for (const uint32_t face : prepared_.castableFaces)
    if (!traced.isSeed[face] && !taken[face]) untried.push_back(face);
  if (untried.empty()) return;
  ComponentSeeds further(prepared_.components.componentOf, traced.values, untried, randomSeed);
  const RunControl quiet{control.stop, {}};
  for (auto batch = further.next(traced.values); !batch.empty(); batch = further.next(traced.values))
    trace(batch, traced, quiet);
}

}  // namespace asdfvk
