#pragma once

#include "cli/exit_code.h"

namespace asdfvk {

/// The only argument of a worker process. Not an option, because only the main process passes it.
inline constexpr const char* kWorkerArgument = "--batch-worker";

/// Runs a worker process: computes the meshes that arrive on its standard input, a socket, until the socket is closed,
/// the device fails or a signal arrives.
[[nodiscard]] ExitCode runWorker();

}  // namespace asdfvk
