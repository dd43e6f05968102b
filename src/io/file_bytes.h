#pragma once

#include <filesystem>
#include <string_view>

#include "core/unset_vector.h"

namespace asdfvk {

/// Reads a whole file; "-" is standard input. Pipes are read to their end. Does not map the file into memory, because
/// truncating a mapped file would end the process. Throws Error{UnreadableInput} with the error of the operating
/// system.
[[nodiscard]] UnsetVector<char> fileBytes(const std::filesystem::path& path);

/// Reads a regular file. Throws Error{UnreadableInput} if the path is a device, FIFO, folder or symbolic link, or if
/// the file cannot be read. The message begins with `where`.
[[nodiscard]] UnsetVector<char> regularFileBytes(const std::filesystem::path& path, std::string_view where);

}  // namespace asdfvk
