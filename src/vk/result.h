#pragma once

#include <volk.h>

#include <string_view>

namespace asdfvk {

/// Throws Error{Device} naming `what` and the result, with a remedy where there is one, unless result is VK_SUCCESS.
void requireSuccess(VkResult result, std::string_view what);

}  // namespace asdfvk
