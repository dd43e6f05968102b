#pragma once

#include <string>
#include <string_view>

namespace asdfvk {

/// The text for an element or for an attribute in quotes: markup becomes character references, control characters other
/// than line ends become spaces, and bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string escapedForHtml(std::string_view text);

/// JSON for a script element: <, > and & become \uXXXX. The JSON must be in ASCII.
[[nodiscard]] std::string escapedForScript(std::string_view json);

}  // namespace asdfvk
