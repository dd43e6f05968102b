#pragma once

#include <volk.h>

#include <string_view>

namespace asdfvk {

/// Throws Error of kind Device with the failed call and the reason unless the result is VK_SUCCESS. call: for example
/// "creating a buffer".
void requireSuccess(VkResult result, std::string_view call);

}  // namespace asdfvk
