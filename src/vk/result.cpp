#include "vk/result.h"

#include <fmt/format.h>

#include "core/error.h"

namespace asdfvk {
namespace {

std::string describe(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory; use a smaller mesh or --backend reference";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost; try again or use --backend reference";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialisation failed; is a Vulkan driver installed?";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no Vulkan driver was found; install one (mesa-vulkan-drivers)";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "a layer is missing; install vulkan-validationlayers";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "an extension is missing";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "a feature is missing";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "too many objects";
    case VK_TIMEOUT:
      return "the device did not answer in time; try again or use --backend reference";
    default:
      return fmt::format("VkResult {}", static_cast<int>(result));
  }
}

}  // namespace

void requireSuccess(VkResult result, std::string_view what) {
  if (result != VK_SUCCESS) throw Error(ErrorKind::Device, fmt::format("{}: {}", what, describe(result)));
}

}  // namespace asdfvk
