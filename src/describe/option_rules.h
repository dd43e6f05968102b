#pragma once

#include "describe/computation_options.h"

/// Rules of implication and exclusion between the options of a computation, for all front ends.
namespace asdfvk {

/// Applies what the given options imply; idempotent. Throws Error{OptionOutOfRange}, Error{UnknownName}, and
/// Error{OptionConflict} if given options have no effect or contradict each other.
ASDFVK_API void complete(ComputationSettings& computation, const GivenOptions& given);
// The constructor of CheckedOptions is complete() for callers of the library: options that differ from the defaults
// count as given.

}  // namespace asdfvk
