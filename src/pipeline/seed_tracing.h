#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/asdf.h"
#include "pipeline/prepared_mesh.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

struct TracedSeeds {
  std::vector<double> values;   ///< #F, NaN where no ray was cast or none was valid.
  std::vector<uint8_t> isSeed;  ///< #F, 1 where rays were cast.
  uint64_t seedCount = 0;
  TraceStatistics statistics;
};

/// How many of the faces that can cast rays are asked for; at least one where there is any.
[[nodiscard]] uint64_t resolveSeedCount(const SeedCount& request, uint64_t castableFaceCount);

/// Traces the cones of the chosen seeds, and then of further ones in each component that has no value yet, until it has
/// one or no face is left to try.
[[nodiscard]] TracedSeeds traceSeeds(const PreparedMesh& prepared, ConeTracer& tracer, const Options& options,
                                     const RunControl& control);

}  // namespace asdfvk
