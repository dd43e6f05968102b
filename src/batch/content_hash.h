#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace asdfvk {

/// 32 hexadecimal digits: XXH3 with 128 bits. It detects changes, not forgery.
[[nodiscard]] std::string contentHash(std::span<const char> bytes);

/// Of the bytes of a file, read in pieces; unset where it cannot be read, or is no regular file.
[[nodiscard]] std::optional<std::string> contentHashOf(const std::filesystem::path& path);

}  // namespace asdfvk
