#pragma once

#include <string>
#include <string_view>

namespace asdfvk::bench {

/// The text as character data or as a quoted attribute of HTML and SVG.
[[nodiscard]] std::string escapeMarkup(std::string_view text);

/// How wide sans-serif text of that size comes out at most, roughly: nothing here knows the fonts of the reader.
[[nodiscard]] double roughTextWidth(std::string_view text, double size);

}  // namespace asdfvk::bench
