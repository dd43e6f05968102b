#pragma once

#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "cli/options.h"

namespace asdfvk {

/// Path of the result of each mesh, "-" for standard output. Throws Error{OptionConflict} where two results, or a
/// result and the picture, have one path, where one of them is an input, and for several meshes with one file.
[[nodiscard]] std::vector<std::string> planOutputs(const CommandLine& line);

/// The fields of --fields; the format where --format or standard output decide it.
[[nodiscard]] WriteOptions writeOptionsOf(const CommandLine& line);

/// Throws Error{OutputNotWritable} where no file can be written: a check before the work begins.
void requireWritablePlace(const std::string& output);

}  // namespace asdfvk
