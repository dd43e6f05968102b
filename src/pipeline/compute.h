#pragma once

#include <memory>

#include "asdf_vk/session.h"
#include "cone/cone.h"
#include "pipeline/judged_surface.h"
#include "pipeline/kept_tracers.h"
#include "pipeline/prepared_scene.h"
#include "pipeline/region.h"
#include "pipeline/session_state.h"

namespace asdfvk {

/// Where a computation takes place.
struct ComputationInput {
  SessionState& session;
  const std::shared_ptr<PreparedScene>& scene;
  const Region* region;  ///< Null: the whole mesh.
  /// Tracers of the scene. Null: the scene is not used again, so that the computation may release its data early.
  KeptTracers* tracers;
  const JudgedSurface* former = nullptr;  ///< The surface of a former version for a comparison; null: none.
};

/// The computation behind Session::compute() and Scene::compute(), from the seeds to the report. The clock writes to
/// result.report.stageSeconds. Throws the errors of Session::compute().
void computeOn(const ComputationInput& input, const CheckedOptions& options, StageClock& clock,
               const RunControl& control, Result& result);

}  // namespace asdfvk
