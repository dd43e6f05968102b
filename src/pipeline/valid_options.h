#pragma once

#include <string>

#include "asdf_vk/options.h"

namespace asdfvk {

/// Throws Error{OptionOutOfRange} or Error{OptionConflict}. Cone, seed count, sampler and solver are validated where
/// they are used.
void requireValid(const Options& options);

/// Whether a solver of solverNames() needs a Vulkan device; false for "auto". Throws Error{UnknownName}.
[[nodiscard]] bool solverNeedsDevice(const std::string& name);

}  // namespace asdfvk
