#pragma once

#include <filesystem>
#include <string_view>

#include "core/unset_vector.h"

namespace asdfvk {

/// Reads a whole file; "-" is standard input. Pipes are read to their end. Does not map the file into memory, because
/// truncating a mapped file would end the process. Throws Error{UnreadableInput} with the error of the operating
/// system.
[[nodiscard]] UnsetVector<char> fileBytes(const std::filesystem::path& path);

/// The file beside `file` that has the relative name `name`, with '/' after each folder. The result is canonical.
/// Throws Error{UnreadableInput} if the file does not exist, if it is outside of the folder of `file`, also by a
/// symbolic link, or if `file` is empty (MeshSource::path). The message begins with `where`.
[[nodiscard]] std::filesystem::path pathBeside(const std::filesystem::path& file, std::string_view name,
                                               std::string_view where);

/// Reads a regular file. Throws Error{UnreadableInput}, also for a device, FIFO, folder or symbolic link. The message
/// begins with `where`.
[[nodiscard]] UnsetVector<char> regularFileBytes(const std::filesystem::path& path, std::string_view where);

}  // namespace asdfvk
