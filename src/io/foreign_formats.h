#pragma once

#include <span>
#include <string>
#include <string_view>

namespace asdfvk {

/// Why the content is not a mesh that a reader of this build reads, and the remedy: "is compressed by xz; unpack it".
/// Empty if the content is none of the known formats without a reader.
[[nodiscard]] std::string foreignContent(std::span<const char> bytes);

/// The text of foreignContent() by the extension alone. extension: in upper or lower case, with or without the dot.
[[nodiscard]] std::string foreignExtension(std::string_view extension);

}  // namespace asdfvk
