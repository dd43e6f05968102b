#pragma once

#include <string>

namespace asdfvk {

/// Whether a solver of solverNames() needs a Vulkan device; false for "auto". Throws Error{UnknownName}.
[[nodiscard]] bool solverNeedsDevice(const std::string& name);

}  // namespace asdfvk
