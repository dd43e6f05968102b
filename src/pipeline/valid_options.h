#pragma once

#include "asdf_vk/options.h"

namespace asdfvk {

/// Throws Error{OptionOutOfRange} or Error{OptionConflict}. Cone, seed count, sampler and solver are validated where
/// they are used.
void requireValid(const Options& options);

}  // namespace asdfvk
