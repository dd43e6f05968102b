#pragma once

#include <string>

#include "asdf_vk/options.h"

namespace asdfvk {

/// The options with what they imply (describe/computation_options.h). Throws Error{OptionOutOfRange},
/// Error{OptionConflict}, Error{UnknownName}; Error{NoDeviceForKernel} for a solver that needs a device without one.
[[nodiscard]] Options completed(const Options& options, bool hasDevice);

/// Whether a solver of solverNames() needs a Vulkan device; false for "auto". Throws Error{UnknownName}.
[[nodiscard]] bool solverNeedsDevice(const std::string& name);

}  // namespace asdfvk
