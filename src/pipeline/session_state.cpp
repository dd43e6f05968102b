#include "pipeline/session_state.h"

#include <fmt/core.h>

#include <optional>
#include <utility>

#include "asdf_vk/error.h"
#include "describe/warnings.h"

namespace asdfvk {
namespace {

/// Whether the device or its driver failed, as opposed to a mesh or an option that it does not allow.
bool isFailureOfDevice(ErrorCode code) {
  return code == ErrorCode::DeviceLost || code == ErrorCode::OutOfDeviceMemory || code == ErrorCode::VulkanFailed ||
         code == ErrorCode::KernelUnsupported || code == ErrorCode::NoUsableDevice;
}

}  // namespace

bool SessionState::replaceBackend(const Error& failure) {
  if (!isFailureOfDevice(failure.code())) return false;
  std::optional<NamedBackend> next = openNextBackend(options_, named.choice);
  if (!next) return false;
  warnings_.push_back(backendReplaced(named.name, next->name, failure));
  next->deviceLines.push_back(fmt::format("{}: failed: {}", named.name, failure.what()));
  solvers.clear();
  replaced_.push_back(std::exchange(named, std::move(*next)));
  lacksMemory_ = failure.code() == ErrorCode::OutOfDeviceMemory;
  return true;
}

void SessionState::returnToDevice() {
  if (!std::exchange(lacksMemory_, false)) return;
  std::swap(named, replaced_.back());
  solvers.clear();
  warnings_.pop_back();
}

}  // namespace asdfvk
