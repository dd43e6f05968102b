#include "pipeline/vk/shared_device.h"

#include <utility>
#include <vector>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "pipeline/backend_choice.h"
#include "pipeline/device_sharing.h"
#include "vk/physical_device.h"

namespace asdfvk {
namespace {

DeviceRequest requestOf(const SessionOptions& options) {
  return {.selector = options.device, .requireGpu = options.requireGpu};
}

std::shared_ptr<const Instance> makeInstance() {
  return std::make_shared<const Instance>(InstanceOptions{.validation = validationRequestedByEnvironment()});
}

/// The state of the DeviceSharing that exists.
struct Sharing {
  std::mutex mutex;
  std::shared_ptr<const Instance> instance;  ///< Null without a DeviceSharing.
  DeviceRequest request;
  uint32_t queueCount = 0;
  std::shared_ptr<SharedDevice> device;
};

Sharing& sharing() {
  static Sharing state;
  return state;
}

}  // namespace

SharedDevice::SharedDevice(std::shared_ptr<const Instance> instance, const DeviceRequest& request,
                           uint32_t maxQueueCount)
    : instance_(std::move(instance)), opened_(openLogicalDevice(*instance_, request, maxQueueCount)) {}

void SharedDevice::makeKernels(const KernelKey& key, FunctionRef<void(bool)> make) {
  const std::lock_guard lock(mutex_);
  // While it waits for other threads, this thread must not run a task that locks the mutex again.
  callIsolated([&] { make(checked_.contains(key)); });
  checked_.insert(key);
}

std::shared_ptr<SharedDevice> openSharedDevice(const SessionOptions& options) {
  const DeviceRequest request = requestOf(options);
  Sharing& state = sharing();
  const std::lock_guard lock(state.mutex);
  if (!state.instance || state.request != request) return std::make_shared<SharedDevice>(makeInstance(), request, 1);
  if (!state.device || state.device->opened().device->isLost()) {
    state.device.reset();
    state.device = std::make_shared<SharedDevice>(state.instance, request, state.queueCount);
  }
  return state.device;
}

std::unique_ptr<DeviceSharing> DeviceSharing::ofGpu(const SessionOptions& options, uint32_t queueCount) {
  if (!mayUseDevice(options.backend) || !mayHaveGpu()) return nullptr;
  try {
    const DeviceRequest request = requestOf(options);
    std::shared_ptr<const Instance> instance = makeInstance();
    const std::vector<DeviceFacts> facts = describeDevices(instance->physicalDevices());
    const DeviceChoice choice = chooseDevice(facts, request);
    if (!choice.index || facts[*choice.index].isCpu()) return nullptr;
    Sharing& state = sharing();
    const std::lock_guard lock(state.mutex);
    state.instance = std::move(instance);
    state.request = request;
    state.queueCount = queueCount;
    return std::unique_ptr<DeviceSharing>(new DeviceSharing);
  } catch (const Error&) {
    return nullptr;  // The sessions report the error.
  }
}

DeviceSharing::~DeviceSharing() {
  Sharing& state = sharing();
  const std::lock_guard lock(state.mutex);
  state.device.reset();
  state.instance.reset();
}

}  // namespace asdfvk
