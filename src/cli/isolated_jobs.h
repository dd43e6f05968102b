#pragma once

#include <string>
#include <vector>

#include "cli/job_context.h"
#include "cli/job_plan.h"

namespace asdfvk {

/// Computes the meshes of the phases in worker processes of this program. arguments: those of the command line. Returns
/// the code of the failure if the workers cannot start, else Done. Throws what the monitor throws.
[[nodiscard]] ExitCode runIsolated(const JobContext& context, const std::vector<JobPhase>& phases,
                                   const std::vector<std::string>& arguments);

}  // namespace asdfvk
