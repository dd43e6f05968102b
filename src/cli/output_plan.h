#pragma once

#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "cli/options.h"

namespace asdfvk {

/// Path of the result of each mesh, "-" for standard output. Throws Error{OptionConflict} if two outputs (results,
/// picture) have the same path, if an output is an input, or if several meshes have one output file.
[[nodiscard]] std::vector<std::string> planOutputs(const CommandLine& line);

/// The fields of --fields, and the format if --format is given or the output is standard output.
[[nodiscard]] WriteOptions writeOptionsOf(const CommandLine& line);

/// Throws Error{OutputNotWritable} where no file can be written: a check before the work begins.
void requireWritablePlace(const std::string& output);

}  // namespace asdfvk
