#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// Seed faces and their results.
struct TracedSeeds {
  explicit TracedSeeds(size_t faceCount) : values(faceCount, kNoValue), isSeed(faceCount, 0) {}

  std::vector<double> values;   ///< #F; NaN where no ray was cast or no hit was valid.
  std::vector<uint8_t> isSeed;  ///< #F, 1 where rays were cast.
  std::vector<uint32_t> faces;  ///< #S, in the order in which they were traced.
  TraceStatistics statistics;
};

}  // namespace asdfvk
