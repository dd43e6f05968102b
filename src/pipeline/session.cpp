#include "asdf_vk/session.h"

#include "describe/session_options.h"
#include "pipeline/backend.h"
#include "pipeline/backend_choice.h"
#include "pipeline/compute.h"

namespace asdfvk {

Session::Session(const SessionOptions& options, SessionOpening opening) {
  requireValid(SessionSettings{options}, OptionSpelling::CamelCase);
  state_ = std::make_unique<SessionState>(options, opening);
}
Session::~Session() = default;

bool Session::isOpen() const { return state_->backend->isOpen(); }
void Session::finishOpening() const {
  if (state_->backend->hasBegun()) (void)state_->backend->open();
}
const std::vector<std::string>& Session::deviceLines() const { return state_->backend->open().deviceLines; }
const std::string& Session::backend() const { return state_->backend->open().name; }
bool Session::runsOnCpu() const { return state_->backend->open().backend->runsOnCpu(); }

Result Session::compute(const MeshView& mesh, const Options& options, const RunControl& control) {
  return compute(mesh, CheckedOptions(options), control);
}

Result Session::compute(const MeshView& mesh, const CheckedOptions& options, const RunControl& control) {
  // Fails before the mesh is prepared if possible.
  if (needsBackend(*options) && state_->backend->isDecided())
    (void)state_->backend->openFor(options->solver, control.stop);
  return state_->compute(!solverNeedsDevice(options->solver), control, [&](const RunControl& rest) {
    Result result;
    StageClock clock(result.report.stageSeconds, rest.stageBegan);
    const auto scene = std::make_shared<PreparedScene>(prepareMesh(mesh, options->orientation, clock, rest));
    computeOn({*state_, scene, nullptr, nullptr}, options, clock, rest, result);
    return result;
  });
}

}  // namespace asdfvk
