#include "pipeline/seed_tracing.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "seeds/component_seeds.h"
#include "seeds/random_permutation.h"

namespace asdfvk {
namespace {

void traceInto(TracedSeeds& traced, const std::vector<uint32_t>& faces, ConeTracer& tracer, const RunControl& control) {
  std::vector<double> values(faces.size());
  const TraceStatistics statistics = tracer.trace(faces, {values}, control);
  traced.statistics.rayCount += statistics.rayCount;
  traced.statistics.redoneConeCount += statistics.redoneConeCount;
  traced.seedCount += faces.size();
  for (size_t i = 0; i < faces.size(); ++i) {
    traced.values[faces[i]] = values[i];
    traced.isSeed[faces[i]] = 1;
  }
}

}  // namespace

uint64_t resolveSeedCount(const SeedCount& request, uint64_t castableFaceCount) {
  if (castableFaceCount == 0 || request.kind == SeedCount::Kind::All) return castableFaceCount;
  if (request.kind == SeedCount::Kind::Count) {
    if (request.count == 0) throw Error(ErrorKind::Usage, "no seeds were asked for; give a count, a percentage or all");
    return std::min(request.count, castableFaceCount);
  }
  if (!(request.share > 0 && request.share <= 1))
    throw Error(ErrorKind::Usage, "the share of seeds is out of range; give more than 0 % and at most 100 %");
  const double count = std::round(request.share * static_cast<double>(castableFaceCount));
  return std::clamp<uint64_t>(static_cast<uint64_t>(count), 1, castableFaceCount);
}

TracedSeeds traceSeeds(const PreparedMesh& prepared, ConeTracer& tracer, const Options& options,
                       const RunControl& control) {
  TracedSeeds traced;
  traced.values.assign(prepared.geometry.areas.size(), kNoValue);
  traced.isSeed.assign(prepared.geometry.areas.size(), 0);
  const uint64_t count = resolveSeedCount(options.seeds, prepared.castableFaces.size());
  if (count == 0) return traced;
  traceInto(traced, randomPermutationSeeds(prepared.castableFaces, count, options.randomSeed), tracer, control);

  std::vector<uint32_t> untried;
  for (const uint32_t face : prepared.castableFaces)
    if (!traced.isSeed[face]) untried.push_back(face);
  if (untried.empty()) return traced;
  ComponentSeeds further(prepared.components.componentOf, traced.values, untried, options.randomSeed);
  const RunControl quiet{control.stop, {}};
  for (auto batch = further.next(traced.values); !batch.empty(); batch = further.next(traced.values))
    traceInto(traced, batch, tracer, quiet);
  return traced;
}

}  // namespace asdfvk
