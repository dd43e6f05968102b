#include "pipeline/kept_tracers.h"

#include <algorithm>
#include <utility>

namespace asdfvk {

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
  if (capacity_ == 0) return make(options, needs, clock);
  if (kept_.size() == capacity_) kept_.pop_back();
  kept_.insert(kept_.begin(), make(options, needs, clock));
  return kept_.front();
}

std::shared_ptr<KeptTracer> KeptTracers::make(const ConeOptions& options, const TracerNeeds& needs,
                                              StageClock& clock) const {
  auto made = std::make_shared<KeptTracer>(KeptTracer{options, makeCone(options), needs, nullptr});
  const Stage stage = setUpStage(backend_);
  {
    const auto scope = clock.time(stage);
    made->tracer = backend_.makeTracer(scene_, made->cone, needs);
    made->variant = backend_.traceVariant();
  }
  clock.transfer(stage, Stage::Encode, made->tracer->encodeSeconds());
  return made;
}

Stage setUpStage(const Backend& backend) { return backend.traceVariant() ? Stage::Upload : Stage::Encode; }

}  // namespace asdfvk
