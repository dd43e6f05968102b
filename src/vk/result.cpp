#include "vk/result.h"

#include <fmt/core.h>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

struct Failure {
  ErrorCode code;
  std::string reason;
};

Failure describe(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return {ErrorCode::OutOfDeviceMemory, "out of host memory"};
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return {ErrorCode::OutOfDeviceMemory, "out of device memory"};
    case VK_ERROR_DEVICE_LOST:
      return {ErrorCode::DeviceLost, "the device was lost"};
    case VK_ERROR_INITIALIZATION_FAILED:
      return {ErrorCode::NoVulkanDriver, "initialisation failed"};
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return {ErrorCode::NoVulkanDriver, "no Vulkan driver was found"};
    case VK_ERROR_LAYER_NOT_PRESENT:
      return {ErrorCode::ValidationFailed, "the validation layers are not installed (vulkan-validationlayers)"};
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return {ErrorCode::VulkanFailed, "an extension is missing"};
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return {ErrorCode::VulkanFailed, "a feature is missing"};
    case VK_ERROR_TOO_MANY_OBJECTS:
      return {ErrorCode::VulkanFailed, "too many objects"};
    default:
      return {ErrorCode::VulkanFailed, fmt::format("VkResult {}", static_cast<int>(result))};
  }
}

}  // namespace

void requireSuccess(VkResult result, std::string_view call) {
  if (result == VK_SUCCESS) return;
  const Failure failure = describe(result);
  throw Error(failure.code, fmt::format("{}: {}", call, failure.reason));
}

}  // namespace asdfvk
