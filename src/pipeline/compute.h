#pragma once

#include <memory>

#include "asdf_vk/session.h"
#include "cone/cone.h"
#include "pipeline/face_domain.h"
#include "pipeline/kept_tracers.h"
#include "pipeline/prepared_scene.h"
#include "pipeline/session_state.h"

namespace asdfvk {

/// Where a computation takes place.
struct ComputationInput {
  SessionState& session;
  const std::shared_ptr<PreparedScene>& scene;
  const FaceDomain& domain;  ///< A domain of the scene.
  KeptTracers& tracers;      ///< Tracers of the scene.
  bool isLast;               ///< The scene is not used again: the computation releases what it does not need any more.
};

/// The computation with completed options behind Session::compute() and Scene::compute(): from the seeds to the report.
/// The clock refers to result.report.stageSeconds. Throws as Session::compute().
void computeOn(const ComputationInput& input, const Options& options, StageClock& clock, const RunControl& control,
               Result& result);

/// The options with what they imply. Throws where they are invalid on this session.
[[nodiscard]] Options completed(const SessionState& session, const Options& options);

}  // namespace asdfvk
