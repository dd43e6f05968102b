#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "cli/batch_monitor.h"
#include "cli/job_plan.h"

namespace asdfvk {

/// The only argument of a worker process. Not an option: users have no need for it.
inline constexpr const char* kWorkerArgument = "--batch-worker";

/// Computes the meshes in worker processes of this program. arguments: of the command line. Returns the failure of the
/// workers to open a device, or Done. Throws what the monitor throws.
[[nodiscard]] ExitCode runIsolated(const CommandLine& line, const std::vector<std::string>& arguments,
                                   MeshRunner& runner, BatchMonitor& monitor, const std::vector<MeshTask>& tasks,
                                   const std::vector<JobPhase>& phases, const std::stop_token& stop);

/// The whole of a worker process: takes meshes as lines of JSON from standard input until that ends.
[[nodiscard]] ExitCode runWorker();

/// Bytes of any kind as UTF-8 text, a character per byte, so that JSON carries them; and back.
[[nodiscard]] std::string textOfBytes(std::string_view bytes);
[[nodiscard]] std::string bytesOfText(std::string_view text);

}  // namespace asdfvk
