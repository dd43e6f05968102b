#include "pipeline/seed_tracing.h"

#include "seeds/component_seeds.h"

namespace asdfvk {

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

void SeedTracing::reserve(TracedSeeds& traced, size_t furtherCount) const {
  traced.faces.reserve(traced.faces.size() + furtherCount);
  if (keepsHits_) traced.hits.reserve(traced.hits.size() + furtherCount * rayCount_);
}

void SeedTracing::traceComponentsWithoutValue(TracedSeeds& traced, uint64_t randomSeed, const RunControl& control) {
  std::vector<uint32_t> untried;
  for (const uint32_t face : prepared_.castableFaces)
    if (!traced.isSeed[face]) untried.push_back(face);
  if (untried.empty()) return;
  ComponentSeeds further(prepared_.components.componentOf, traced.values, untried, randomSeed);
  const RunControl quiet{control.stop, {}};
  for (auto batch = further.next(traced.values); !batch.empty(); batch = further.next(traced.values))
    trace(batch, traced, quiet);
}

}  // namespace asdfvk
