#pragma once

#include <memory>
#include <span>

#include "bvh/bvh.h"
#include "pipeline/computation.h"
#include "pipeline/scene_tracers.h"
#include "trace/cone_tracer.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

/// Casts the rays of seeds of one computation. Its destructor releases the tracer, unless `tracers` keep it, and the
/// nodes of the hierarchy if they are not needed later.
class SeedTracing {
 public:
  /// The computation must outlive it. released: the hierarchy whose nodes the destructor releases; null: none.
  SeedTracing(const Computation& computation, SceneTracers& tracers, Bvh* released);
  ~SeedTracing();
  SeedTracing(const SeedTracing&) = delete;
  SeedTracing& operator=(const SeedTracing&) = delete;

  /// Of the kernels; unset without Vulkan.
  [[nodiscard]] const std::optional<TraceVariant>& traceVariant() const { return tracer_->variant; }
  /// Where later calls of trace() keep hits, of one TracedSeeds only; null: in TracedSeeds::hits. Where the memory of
  /// the store does not suffice, TracedSeeds::hits receives all hits after all.
  void keepHitsIn(HitStore* store) { hitStore_ = store; }
  /// Adds `faces`, none of which may be in `traced`.
  void trace(std::span<const uint32_t> faces, TracedSeeds& traced, const RunControl& control);
  /// Reserves memory for further seeds, so that growing does not copy the hits, which are most of the memory.
  void reserve(TracedSeeds& traced, size_t furtherCount);
  /// Adds seeds to each component without a value until it has one or no face is left.
  void traceComponentsWithoutValue(TracedSeeds& traced, const RunControl& control);

 private:
  void reserveStored(TracedSeeds& traced, size_t furtherCount);

  const Computation& computation_;
  Bvh* released_;
  std::shared_ptr<SceneTracer> tracer_;
  HitStore* hitStore_ = nullptr;
};

}  // namespace asdfvk
