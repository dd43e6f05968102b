#pragma once

#include <cstddef>
#include <vector>

#include "asdf_vk/report.h"
#include "cli/exit_code.h"
#include "describe/computation_options.h"

namespace asdfvk {

/// The failures of requested checks, including checks that were not possible. Failures that a baseline has are left
/// out.
[[nodiscard]] std::vector<Failure> failedChecks(const ComputationSettings& computation, const Report& report);

/// Number of the places that a baseline has.
[[nodiscard]] size_t knownCountOf(const Report& report);

}  // namespace asdfvk
