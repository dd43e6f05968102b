#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "pipeline/computation.h"
#include "pipeline/kept_tracers.h"
#include "pipeline/prepared_scene.h"
#include "trace/cone_tracer.h"
#include "trace/seeds.h"

namespace asdfvk {

/// Returns the traceable nodes of the domain that are not seeds and whose component has no value from a seed with
/// holds(seed).
template <typename Holds>
[[nodiscard]] std::vector<uint32_t> untriedWithoutValue(const FaceDomain& domain, const Seeds& seeds,
                                                        const Holds& holds) {
  std::vector<uint8_t> hasValue(domain.componentCount, 0);
  size_t withoutValueCount = domain.componentCount;
  for (size_t seed = 0; seed < seeds.size() && withoutValueCount > 0; ++seed)
    if (holds(seed) && std::isfinite(seeds.values[seed]) &&
        std::exchange(hasValue[domain.componentOf[seeds.nodes[seed]]], 1) == 0)
      --withoutValueCount;
  if (withoutValueCount == 0) return {};
  const std::vector<uint8_t> isSeed = seedFlags(seeds, domain.size());
  return selectInParallel(domain.traceable,
                          [&](uint32_t node) { return isSeed[node] == 0 && hasValue[domain.componentOf[node]] == 0; });
}

/// Where the rays of a computation are cast.
struct RaySource {
  PreparedScene& scene;
  KeptTracers* kept;  ///< Null: the tracer, and nodes of the hierarchy, are not used again.
  bool keepsNodes;    ///< Whether the nodes of the hierarchy are needed after the last ray.
};

/// Casts the rays of the seeds of one computation. The destructor releases the tracer, unless RaySource::kept keeps it.
/// It also releases the nodes of the hierarchy if they are not needed later.
class SeedTracing {
 public:
  /// Builds the hierarchy if there is none. The computation and the scene must outlive this object. Throws
  /// Error{Device} and Error{Cancelled}.
  SeedTracing(const Computation& computation, const RaySource& source, const RunControl& control);
  ~SeedTracing();
  SeedTracing(const SeedTracing&) = delete;
  SeedTracing& operator=(const SeedTracing&) = delete;

  /// The variant of the kernels; unset without Vulkan.
  [[nodiscard]] const std::optional<TraceVariant>& traceVariant() const { return tracer_->variant; }
  /// Memory for the hits of the seeds on the device that predicts from them; null if no device predicts.
  [[nodiscard]] std::unique_ptr<DeviceHits> makeDeviceHits() const;
  /// Makes room for the hits of `count` further seeds. If the device has too little memory, the hits move to the host.
  void reserveHits(Seeds& seeds, size_t count, const RunControl& control);
  /// Appends nodes that are no seeds yet. kinds: one per node.
  void trace(std::span<const uint32_t> nodes, std::span<const SeedKind> kinds, Seeds& seeds, const RunControl& control);
  void trace(std::span<const uint32_t> nodes, SeedKind kind, Seeds& seeds, const RunControl& control) {
    trace(nodes, std::vector<SeedKind>(nodes.size(), kind), seeds, control);
  }
  /// Appends seeds in each component without a value, held-out seeds ignored, until the component has a value or no
  /// node is left.
  void traceComponentsWithoutValue(Seeds& seeds, const RunControl& control);

 private:
  const Computation& computation_;
  PreparedScene& scene_;
  bool keepsNodes_;
  std::shared_ptr<KeptTracer> tracer_;
};

/// Copies hits from the device to the host. If the device fails, the reference traces the seeds again. Throws
/// Error{Cancelled}.
void moveHitsToHost(const Computation& computation, PreparedScene& scene, Seeds& seeds, const RunControl& control);

}  // namespace asdfvk
