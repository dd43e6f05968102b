#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// Faces that cast rays, and what came of it.
struct TracedSeeds {
  explicit TracedSeeds(size_t faceCount) : values(faceCount, kNoValue), isSeed(faceCount, 0) {}

  std::vector<double> values;   ///< #F, NaN where no ray was cast or none was valid.
  std::vector<uint8_t> isSeed;  ///< #F, 1 where rays were cast.
  std::vector<uint32_t> faces;  ///< #S, in the order in which they were traced.
  std::vector<ConeHit> hits;    ///< #S x rays, see ConeResults::hits; empty if nobody wants them.
  TraceStatistics statistics;
};

}  // namespace asdfvk
