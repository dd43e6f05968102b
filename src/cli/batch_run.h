#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "cli/one_mesh.h"

namespace asdfvk {

/// The only argument of a worker process. The argument is not documented, because only the main process passes it.
inline constexpr const char* kWorkerArgument = "--batch-worker";

/// Reads and computes each mesh, writes its result and reports on it. A mesh that fails is reported and does not affect
/// other meshes. A missing device or a stop request ends the run. meshes: the arguments of the command line. Returns
/// the code of SharedExitCode, or the code of a missing device or cancellation. Throws Error{OptionConflict} before the
/// first mesh if outputs contradict each other; Error{UnreadableInput} if a folder or list of meshes cannot be read;
/// Error{OutputNotWritable} if the report, the log or a page of all meshes cannot be written.
[[nodiscard]] ExitCode computeBatch(const std::vector<std::string>& meshes, const MeshSettings& settings,
                                    const BatchOptions& batch, const std::stop_token& stop);

void runWorker();

}  // namespace asdfvk
