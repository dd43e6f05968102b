#pragma once

#include <volk.h>

#include <string_view>

namespace asdfvk {

/// Throws Error of kind Device if the result is not VK_SUCCESS. call: the failed call, such as "creating a buffer".
void requireSuccess(VkResult result, std::string_view call);

}  // namespace asdfvk
