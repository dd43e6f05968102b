#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "cli/batch_monitor.h"
#include "cli/job_plan.h"

namespace asdfvk {

/// Computes the meshes in worker processes of this program. arguments: of the command line. Returns the failure of the
/// workers to start, or Done. Throws what the monitor throws.
[[nodiscard]] ExitCode runIsolated(const CommandLine& line, const std::vector<std::string>& arguments,
                                   MeshRunner& runner, BatchMonitor& monitor, const std::vector<MeshTask>& tasks,
                                   const std::vector<JobPhase>& phases, const std::stop_token& stop);

}  // namespace asdfvk
