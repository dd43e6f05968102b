#pragma once

#include <stop_token>

#include "cli/exit_code.h"
#include "cli/options.h"

namespace asdfvk {

/// Reads, computes and writes each mesh and reports on it. A mesh that fails is reported and the others are done; a
/// missing device and a stop request end the run. Returns Done or the code of the first failure. Throws Error{Usage}
/// before any work when the outputs contradict each other, Error{Output} when the report cannot be written.
[[nodiscard]] ExitCode runMeshes(const CommandLine& line, const std::stop_token& stop);

/// Prints the devices on standard output.
void printDevices(const CommandLine& line);

}  // namespace asdfvk
