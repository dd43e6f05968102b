#pragma once

#include <volk.h>

#include <string_view>

namespace asdfvk {

/// Unless the result is VK_SUCCESS, throws Error of kind Device. call: the failed call, such as "creating a buffer".
void requireSuccess(VkResult result, std::string_view call);

}  // namespace asdfvk
