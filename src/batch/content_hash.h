#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace asdfvk {

/// Returns the 128-bit XXH3 hash of the bytes as 32 hexadecimal digits. The hash detects accidental changes only.
[[nodiscard]] std::string contentHash(std::span<const char> bytes);

/// Returns contentHash() of the bytes of a file. Unset if the file is not a regular file or cannot be read.
[[nodiscard]] std::optional<std::string> contentHashOf(const std::filesystem::path& path);

}  // namespace asdfvk
