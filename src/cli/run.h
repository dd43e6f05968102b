#pragma once

#include <stop_token>

#include "cli/exit_code.h"
#include "cli/options.h"

namespace asdfvk {

/// Reads, computes and writes each mesh and reports on it. A mesh that fails is reported and does not affect the
/// others; a missing device or a stop request ends the run. Returns Done or the code of the first failure. Throws
/// Error{OptionConflict} before any work where outputs contradict each other, Error{OutputNotWritable} where the report
/// cannot be written.
[[nodiscard]] ExitCode runMeshes(const CommandLine& line, const std::stop_token& stop);

/// Prints the devices on standard output.
void printDevices(const CommandLine& line);

/// Prints the report on the device on standard output. Returns Done, or Device where its self-test failed. Throws as
/// reportDevice(), and DeviceReport::failure after printing.
[[nodiscard]] ExitCode printDeviceReport(const CommandLine& line, const std::stop_token& stop);

}  // namespace asdfvk
