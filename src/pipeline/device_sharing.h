#pragma once

#include <cstdint>
#include <memory>

#include "asdf_vk/session.h"

namespace asdfvk {

/// While it exists, sessions with the same options share one GPU, which stays open. Each session has memory, kernels
/// and command buffers of its own, so that threads compute on the GPU at the same time, each with a session. A session
/// that is opened after the device was lost opens it again, and later sessions share it. At most one object may exist.
class DeviceSharing {
 public:
  /// Null if sessions with these options do not open a GPU, or if mayHaveGpu() is false. Opens no device.
  /// queueCount: greatest number of queues of the device, which the sessions use in turn.
  [[nodiscard]] static std::unique_ptr<DeviceSharing> ofGpu(const SessionOptions& options, uint32_t queueCount);
  ~DeviceSharing();
  DeviceSharing(const DeviceSharing&) = delete;
  DeviceSharing& operator=(const DeviceSharing&) = delete;

 private:
  DeviceSharing() = default;
};

}  // namespace asdfvk
