#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asdfvk {

/// Decodes base64 (RFC 4648), with or without padding. Empty if a character or the length is invalid.
[[nodiscard]] std::optional<std::vector<char>> base64Bytes(std::string_view text);

/// Encodes bytes as base64 with padding.
[[nodiscard]] std::string base64Text(std::span<const char> bytes);

}  // namespace asdfvk
