#include "asdf_vk/error.h"
#include "asdf_vk/session.h"
#include "core/no_vulkan.h"
#include "pipeline/backend.h"
#include "pipeline/device_sharing.h"

namespace asdfvk {

std::unique_ptr<Backend> makeVulkanBackend(const SessionOptions&) { throw Error(ErrorCode::NoUsableDevice, kNoVulkan); }

std::unique_ptr<EncodedScene> encodeForVulkan(const TraceScene&) { return nullptr; }

std::unique_ptr<DeviceSharing> DeviceSharing::ofGpu(const SessionOptions&, uint32_t) { return nullptr; }
DeviceSharing::~DeviceSharing() = default;

std::vector<DeviceInfo> listDevices(std::string* reason, bool) {
  if (reason != nullptr) *reason = kNoVulkan;
  return {};
}

}  // namespace asdfvk
