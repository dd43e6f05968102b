#pragma once

#include <string>

#include "asdf_vk/options.h"

namespace asdfvk {

/// Throws Error{OptionOutOfRange}, Error{OptionConflict}, Error{UnknownName}; Error{NoDeviceForKernel} for a solver
/// that needs a device without one. makeCone() validates the cone.
void requireValid(const Options& options, bool hasDevice);

/// Throws Error{OptionOutOfRange}.
void requireValid(const CgalSegmentationOptions& options);

/// Whether a solver of solverNames() needs a Vulkan device; false for "auto". Throws Error{UnknownName}.
[[nodiscard]] bool solverNeedsDevice(const std::string& name);

}  // namespace asdfvk
