#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace asdfvk {

/// Decodes base64 (RFC 4648), with or without its padding. Unset for a character that is not of it.
[[nodiscard]] std::optional<std::vector<char>> base64Bytes(std::string_view text);

}  // namespace asdfvk
