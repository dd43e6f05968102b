#pragma once

#include <string>
#include <string_view>

namespace asdfvk {

/// Escapes text for an element or a quoted attribute of HTML. Markup becomes character references. Control characters
/// other than line ends become spaces. Each byte of invalid UTF-8 becomes U+FFFD.
[[nodiscard]] std::string escapedForHtml(std::string_view text);

/// Escapes JSON for a script element: <, > and & become \uXXXX. Precondition: the JSON is in ASCII.
[[nodiscard]] std::string escapedForScript(std::string_view json);

}  // namespace asdfvk
