#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "cli/one_mesh.h"

namespace asdfvk {

/// The only argument of a worker process. Not an option, because only the main process passes it.
inline constexpr const char* kWorkerArgument = "--batch-worker";

/// Reads, computes and writes each mesh and reports on it. A mesh that fails is reported and does not affect the
/// others; a missing device or a stop request ends the run. meshes: as on the command line. Returns Done or the code of
/// SharedExitCode. Throws Error{OptionConflict} before any work where outputs contradict each other,
/// Error{UnreadableInput} where a folder or list of meshes cannot be read, Error{OutputNotWritable} where the report,
/// the log or a page of all meshes cannot be written.
[[nodiscard]] ExitCode computeBatch(const std::vector<std::string>& meshes, const MeshSettings& settings,
                                    const BatchOptions& batch, const std::stop_token& stop);

/// Runs a worker process.
void runWorker();

}  // namespace asdfvk
