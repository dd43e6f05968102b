#pragma once

#include <span>
#include <string>

namespace asdfvk {

/// Whether the bytes are a byte order mark of UTF-16 and text: no control characters at its beginning.
[[nodiscard]] bool isUtf16Text(std::span<const char> bytes);

/// Converts a text with a byte order mark to UTF-8. Unpaired surrogates become U+FFFD. Throws Error{UnreadableInput}
/// for an odd number of bytes.
[[nodiscard]] std::string utf8Of(std::span<const char> utf16);

}  // namespace asdfvk
