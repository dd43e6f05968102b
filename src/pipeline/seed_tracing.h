#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bvh/bvh.h"
#include "pipeline/computation.h"
#include "pipeline/kept_tracers.h"
#include "trace/cone_tracer.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

/// Returns the traceable faces of the domain that are not seeds and whose component has no value.
[[nodiscard]] std::vector<uint32_t> untriedWithoutValue(const FaceDomain& domain, const TracedSeeds& traced);

/// Casts the rays of seeds of one computation. Its destructor releases the tracer, unless `tracers` keep it, and the
/// nodes of the hierarchy if they are not needed later.
class SeedTracing {
 public:
  /// The computation must outlive this object. released: the hierarchy whose nodes the destructor releases; null: none.
  SeedTracing(const Computation& computation, KeptTracers& tracers, Bvh* released);
  ~SeedTracing();
  SeedTracing(const SeedTracing&) = delete;
  SeedTracing& operator=(const SeedTracing&) = delete;

  /// The variant of the kernels; unset without Vulkan.
  [[nodiscard]] const std::optional<TraceVariant>& traceVariant() const { return tracer_->variant; }
  /// Adds `faces`, none of which may be in `traced`, and their hits.
  void trace(std::span<const uint32_t> faces, TracedSeeds& traced, const RunControl& control);
  /// Adds seeds to each component without a value until the component has a value or no face is left.
  void traceComponentsWithoutValue(TracedSeeds& traced, const RunControl& control);

 private:
  const Computation& computation_;
  Bvh* released_;
  std::shared_ptr<KeptTracer> tracer_;
};

}  // namespace asdfvk
