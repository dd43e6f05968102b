#pragma once

#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "cone/cone.h"
#include "pipeline/lazy_backend.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/region.h"
#include "pipeline/stage_clock.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// Data shared by all steps of one computation. References only: computeOn() and its caller own everything.
struct Computation {
  const Options& options;
  const PreparedMesh& prepared;
  const FaceDomain& domain;
  const InputFaceSet& region;  ///< The computed faces: those that get values.
  const TraceScene& scene;
  const Cone& cone;
  LazyBackend& backend;
  StageClock& clock;
  std::vector<Warning>& warnings;

  [[nodiscard]] bool predicts() const { return options.interpolation.guidance == Guidance::Prediction; }
  /// Whether hits of rays are kept for the prediction.
  [[nodiscard]] bool keepsHits() const {
    return predicts() && (options.seeds.kind != SeedCount::Kind::All || options.interpolation.pooling > 0);
  }
  /// Whether faces that cannot be traced, and traced faces without a valid ray, have no value in the result. Otherwise
  /// such faces are interpolated.
  [[nodiscard]] bool keepsMissing() const { return cone.definition == Definition::Cgal; }
};

}  // namespace asdfvk
