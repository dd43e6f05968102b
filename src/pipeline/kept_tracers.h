#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "cone/cone.h"
#include "pipeline/backend.h"
#include "pipeline/stage_clock.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// A tracer with the cone that it refers to.
struct KeptTracer {
  /// encoded: see Backend::makeTracer(). The time of creation is charged to the clock. Throws the errors of makeCone(),
  /// and Error{Device}.
  KeptTracer(Backend& backend, const TraceScene& scene, const ConeOptions& coneOptions, const TracerNeeds& tracerNeeds,
             StageClock& clock, std::unique_ptr<EncodedScene> encoded = nullptr);

  ConeOptions options;
  Cone cone;
  TracerNeeds needs;
  std::unique_ptr<ConeTracer> tracer;
  std::optional<TraceVariant> variant = {};  ///< The variant of the kernels; unset without Vulkan.
};

/// The tracers of one scene. The tracers used last are kept, because making a tracer encodes and uploads the hierarchy.
class KeptTracers {
 public:
  /// Backend and scene must outlive this object and all tracers. capacity: number of tracers to keep, at least 1.
  KeptTracers(Backend& backend, const TraceScene& scene, size_t capacity)
      : backend_(backend), scene_(scene), capacity_(capacity) {}

  [[nodiscard]] const Backend& backend() const { return backend_; }
  /// A tracer for these cones: a kept tracer that serves the needs, or a new one. Throws the errors of KeptTracer().
  [[nodiscard]] std::shared_ptr<KeptTracer> get(const ConeOptions& options, const TracerNeeds& needs,
                                                StageClock& clock);

 private:
  Backend& backend_;
  TraceScene scene_;
  size_t capacity_;
  std::vector<std::shared_ptr<KeptTracer>> kept_;  // Ordered by last use, the latest first.
};

/// The stage that includes the time to create and release tracers: Stage::Upload with Vulkan, else Stage::Encode.
[[nodiscard]] Stage setUpStage(const Backend& backend);

}  // namespace asdfvk
