#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "cli/options.h"

namespace asdfvk {

/// Reads, computes and writes each mesh and reports on it. A mesh that fails is reported and does not affect the
/// others; a missing device or a stop request ends the run. arguments: those that `line` was parsed from. Returns Done,
/// the code of the only mesh, or that of SharedExitCode. Throws Error{OptionConflict} before any work where outputs
/// contradict each other, Error{UnreadableInput} where a folder or list of meshes cannot be read,
/// Error{OutputNotWritable} where the report or the log cannot be written.
[[nodiscard]] ExitCode runMeshes(const CommandLine& line, const std::vector<std::string>& arguments,
                                 const std::stop_token& stop);

/// Prints the devices on standard output. Returns Done, or Device where a GPU is required and none is usable.
[[nodiscard]] ExitCode printDevices(const CommandLine& line);

/// Prints the report on the device on standard output. Returns Done, or Device where its self-test failed. Throws as
/// reportDevice(), and DeviceReport::failure after printing.
[[nodiscard]] ExitCode printDeviceReport(const CommandLine& line, const std::stop_token& stop);

}  // namespace asdfvk
