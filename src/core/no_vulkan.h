#pragma once

namespace asdfvk {

/// The reason in errors of a build with ASDF_VK_VULKAN=OFF. Files without_vk.cpp replace the folders vk/ there.
inline constexpr const char* kNoVulkan =
    "this build of asdf-vk has no Vulkan; build with ASDF_VK_VULKAN=ON, or use the backend cpu";

}  // namespace asdfvk
