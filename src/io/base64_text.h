#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace asdfvk {

/// Decodes base64 (RFC 4648), with or without padding. Returns nothing for text with other characters or of an
/// impossible length.
[[nodiscard]] std::optional<std::vector<char>> base64Bytes(std::string_view text);

}  // namespace asdfvk
