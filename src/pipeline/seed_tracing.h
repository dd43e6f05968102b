#pragma once

#include <memory>
#include <span>

#include "bvh/bvh.h"
#include "pipeline/computation.h"
#include "trace/ball_shrinker.h"
#include "trace/cone_tracer.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

/// Casts the rays of seeds of one mesh. Owns the tracer, and the nodes of the hierarchy unless they are needed later:
/// both are released by its destructor.
class SeedTracing {
 public:
  /// The computation must outlive it. keepsNodes: the nodes of `bvh` are left in place.
  SeedTracing(const Computation& computation, Bvh& bvh, bool keepsNodes);
  ~SeedTracing();
  SeedTracing(const SeedTracing&) = delete;
  SeedTracing& operator=(const SeedTracing&) = delete;

  /// Adds `faces`, none of which may be in `traced`. With Measure::Thickness also their thickness.
  void trace(std::span<const uint32_t> faces, TracedSeeds& traced, const RunControl& control);
  /// Reserves memory for further seeds, so that growing does not copy the hits, which are most of the memory.
  void reserve(TracedSeeds& traced, size_t furtherCount) const;
  /// Adds seeds to each component without a value until it has one or no face is left.
  void traceComponentsWithoutValue(TracedSeeds& traced, const RunControl& control);

 private:
  void measureThickness(std::span<const uint32_t> faces, std::span<const ConeHit> hits, TracedSeeds& traced,
                        const RunControl& control);

  const Computation& computation_;
  Bvh& bvh_;
  bool keepsNodes_;
  std::unique_ptr<ConeTracer> tracer_;
  OpposingWalls walls_;
  std::unique_ptr<BallShrinker> shrinker_;  ///< Null unless the thickness is measured. Destroyed before the tracer.
};

}  // namespace asdfvk
