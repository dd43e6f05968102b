#pragma once

#include "cli/exit_code.h"

namespace asdfvk {

/// The only argument of a worker process. Not an option: users have no need for it.
inline constexpr const char* kWorkerArgument = "--batch-worker";

/// The whole of a worker process: takes meshes from the socket that is its standard input until that ends.
[[nodiscard]] ExitCode runWorker();

}  // namespace asdfvk
