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
