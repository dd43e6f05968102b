#include "pipeline/session_state.h"

#include <fmt/core.h>

#include <optional>
#include <utility>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "describe/warnings.h"
#include "pipeline/backend_choice.h"

namespace asdfvk {
namespace {

/// Whether the device or its driver failed, as opposed to a mesh or an option that it does not allow.
bool isFailureOfDevice(ErrorCode code) {
  return code == ErrorCode::DeviceLost || code == ErrorCode::OutOfDeviceMemory || code == ErrorCode::VulkanFailed ||
         code == ErrorCode::KernelUnsupported || code == ErrorCode::NoUsableDevice;
}

}  // namespace

SessionState::SessionState(const SessionOptions& options, SessionOpening opening)
    : backend(std::make_unique<LazyBackend>(options, opening)),
      options_(options),
      choosesByRays_(options.backend == BackendChoice::Automatic && !requestsVulkan(options)),
      isUsed_(opening == SessionOpening::Now) {
  if (!choosesByRays_ || !mayHaveGpu()) backend->begin();
}

std::optional<uint64_t> SessionState::leastRays(const Options& options) const {
  if (!choosesByRays_ || solverNeedsDevice(options.solver)) return std::nullopt;
  const bool hasGpu = isUsed_ ? !backend->open().backend->runsOnCpu() : mayHaveGpu();
  return hasGpu ? std::optional(leastRaysForGpu(threadLimit(), isUsed_)) : std::nullopt;
}

LazyBackend& SessionState::backendFor(const Options& options, uint64_t rayCount, Report& report) {
  const bool needsNone = sessionOptionsFor(options_, options).backend != options_.backend;
  if (!needsNone) report.leastRaysForGpu = leastRays(options);
  if (needsNone || rayCount < report.leastRaysForGpu.value_or(0)) {
    if (!cpu_) cpu_ = std::make_unique<LazyBackend>(SessionOptions{.backend = BackendChoice::Cpu}, SessionOpening::Now);
    return *cpu_;
  }
  isUsed_ = true;
  backend->begin();
  return *backend;
}

bool SessionState::replaceBackend(const Error& failure) {
  if (!isFailureOfDevice(failure.code()) || !backend->isOpen()) return false;
  const NamedBackend& failed = backend->open();
  std::optional<NamedBackend> next = openNextBackend(options_, failed.choice);
  if (!next) return false;
  warnings_.push_back(backendReplaced(failed.name, next->name, failure));
  next->deviceLines.push_back(fmt::format("{}: failed: {}", failed.name, failure.what()));
  replaced_.push_back(std::exchange(backend, std::make_unique<LazyBackend>(std::move(*next))));
  lacksMemory_ = failure.code() == ErrorCode::OutOfDeviceMemory;
  return true;
}

void SessionState::returnToDevice() {
  if (!std::exchange(lacksMemory_, false)) return;
  std::swap(backend, replaced_.back());
  warnings_.pop_back();
}

}  // namespace asdfvk
