#pragma once

#include <string>

#include "asdf_vk/options.h"

namespace asdfvk {

/// The options together with the settings that they imply (describe/computation_options.h). Throws
/// Error{OptionOutOfRange}, Error{OptionConflict}, Error{UnknownName}; and Error{NoDeviceForKernel} if the solver needs
/// a device and hasDevice is false.
[[nodiscard]] Options completed(const Options& options, bool hasDevice);

/// Whether a solver of solverNames() needs a Vulkan device; false for "auto". Throws Error{UnknownName}.
[[nodiscard]] bool solverNeedsDevice(const std::string& name);

}  // namespace asdfvk
