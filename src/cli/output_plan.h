#pragma once

#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "cli/options.h"

namespace asdfvk {

/// Where the result of each mesh goes: one entry per mesh, "-" for standard output. Throws Error{Usage} when the names
/// contradict each other: two results or a result and the picture in one file, one of
/// them in place of an input, several meshes and one file.
[[nodiscard]] std::vector<std::string> planOutputs(const CommandLine& line);

/// The fields of --fields; the format where --format or standard output decide it.
[[nodiscard]] WriteOptions writeOptionsOf(const CommandLine& line);

/// Throws Error{Output} when it is plain that no file can be written there, so that it is told before the work.
void requireWritablePlace(const std::string& output);

}  // namespace asdfvk
