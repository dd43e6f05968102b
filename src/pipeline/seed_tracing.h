#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/prepared_mesh.h"
#include "trace/cone_tracer.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

/// Casts the rays of seeds of one mesh.
class SeedTracing {
 public:
  /// What it refers to must outlive it. rayCount: per cone. keepsHits: `tracer` must write them.
  SeedTracing(const PreparedMesh& prepared, ConeTracer& tracer, size_t rayCount, bool keepsHits)
      : prepared_(prepared), tracer_(tracer), rayCount_(rayCount), keepsHits_(keepsHits) {}

  /// Adds `faces`, none of which may be in `traced`.
  void trace(std::span<const uint32_t> faces, TracedSeeds& traced, const RunControl& control);

  /// Makes room for so many further seeds, so that hits, most of the memory, need not be copied to grow.
  void reserve(TracedSeeds& traced, size_t furtherCount) const;

  /// Adds seeds to each component that has no value yet until it has one, or no face left to try.
  void traceComponentsWithoutValue(TracedSeeds& traced, uint64_t randomSeed, const RunControl& control);

 private:
  const PreparedMesh& prepared_;
  ConeTracer& tracer_;
  size_t rayCount_;
  bool keepsHits_;
};

}  // namespace asdfvk
