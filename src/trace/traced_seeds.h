#pragma once

#include <cstdint>
#include <vector>

#include "core/unset_vector.h"
#include "mesh/mesh.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

struct TracedSeeds {
  /// raysPerSeed: 0 if hits are not kept.
  explicit TracedSeeds(size_t faceCount, size_t raysPerSeed = 0)
      : values(faceCount, kNoValue), isSeed(faceCount, 0), hitsPerSeed(raysPerSeed) {}

  std::vector<double> values;   ///< #F; NaN if no ray was cast or no hit was valid.
  std::vector<uint8_t> isSeed;  ///< #F, 1 if rays were cast.
  std::vector<uint32_t> faces;  ///< #S, in the order in which they were traced.
  UnsetVector<ConeHit> hits;    ///< #S x hitsPerSeed, see ConeResults::hits.
  size_t hitsPerSeed = 0;
  TraceStatistics statistics;
};

}  // namespace asdfvk
