#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <utility>
#include <variant>

#include "asdf_vk/session.h"
#include "core/function_ref.h"
#include "trace/vk/vulkan_cone_kernel.h"
#include "vk/device.h"
#include "vk/instance.h"

namespace asdfvk {

/// An open device, which the backends of several threads use. Thread-safe.
class SharedDevice {
 public:
  /// Throws Error of kind Device.
  SharedDevice(std::shared_ptr<const Instance> instance, const DeviceRequest& request, uint32_t maxQueueCount);

  [[nodiscard]] const Instance& instance() const { return *instance_; }
  [[nodiscard]] const OpenedLogicalDevice& opened() const { return opened_; }

  /// What kernels are compiled for: cones, or predictions with this number of rays.
  using KernelKey = std::variant<ConeKernelRequest, std::pair<Definition, uint32_t>>;
  /// Calls make(), for one thread at a time. isChecked: whether the kernels of an earlier call with this key passed
  /// their check, in whatever thread. Throws the errors of make().
  void makeKernels(const KernelKey& key, FunctionRef<void(bool isChecked)> make);

 private:
  std::shared_ptr<const Instance> instance_;
  OpenedLogicalDevice opened_;  // Destroyed before the instance.
  std::mutex mutex_;
  std::set<KernelKey> checked_;
};

/// The device that all sessions share while a DeviceSharing exists; otherwise a further device. Throws Error of kind
/// Device.
[[nodiscard]] std::shared_ptr<SharedDevice> openSharedDevice(const SessionOptions& options);

}  // namespace asdfvk
