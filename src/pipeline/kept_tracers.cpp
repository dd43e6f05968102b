#include "pipeline/kept_tracers.h"

#include <algorithm>
#include <utility>

namespace asdfvk {

KeptTracer::KeptTracer(Backend& backend, const TraceScene& scene, const ConeOptions& coneOptions,
                       const TracerNeeds& tracerNeeds, StageClock& clock, std::unique_ptr<EncodedScene> encoded)
    : options(coneOptions), cone(makeCone(coneOptions)), needs(tracerNeeds) {
  const Stage stage = setUpStage(backend);
  {
    const auto scope = clock.time(stage);
    tracer = backend.makeTracer(scene, cone, needs, std::move(encoded));
    variant = backend.traceVariant();
  }
  clock.transfer(stage, Stage::Encode, tracer->encodeSeconds());
}

std::shared_ptr<KeptTracer> KeptTracers::get(const ConeOptions& options, const TracerNeeds& needs, StageClock& clock) {
  const auto found =
      std::find_if(kept_.begin(), kept_.end(), [&](const auto& entry) { return entry->options == options; });
  if (found != kept_.end()) {
    if ((*found)->needs.hits || !needs.hits) {
      std::rotate(kept_.begin(), found, found + 1);
      return kept_.front();
    }
    kept_.erase(found);  // Erased before the new tracer is made, which lowers the peak of memory.
  }
  if (kept_.size() == capacity_) kept_.pop_back();
  kept_.insert(kept_.begin(), std::make_shared<KeptTracer>(backend_, scene_, options, needs, clock));
  return kept_.front();
}

Stage setUpStage(const Backend& backend) { return backend.traceVariant() ? Stage::Upload : Stage::Encode; }

}  // namespace asdfvk
