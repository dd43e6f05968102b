#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace asdfvk {

/// The 128-bit XXH3 hash of the bytes as 32 hexadecimal digits. Not a cryptographic hash: it detects accidental changes
/// only.
[[nodiscard]] std::string contentHash(std::span<const char> bytes);

/// contentHash() of the bytes of a file, which is read in pieces. Unset where the file cannot be read or is not a
/// regular file.
[[nodiscard]] std::optional<std::string> contentHashOf(const std::filesystem::path& path);

}  // namespace asdfvk
