#pragma once

#include <string_view>
#include <utility>
#include <vector>

namespace asdfvk {

/// In font units: x to the right of the glyph's left side, y up from the baseline. Capitals are kCapHeight high.
struct FontPoint {
  double x = 0, y = 0;
};
inline constexpr double kCapHeight = 14;

/// A glyph as centre lines of strokes, each a chain of points; a single point is a dot.
struct Glyph {
  double width = 0;
  std::vector<std::vector<FontPoint>> strokes;
};

/// Every printable ASCII character has a glyph; all other bytes have that of the question mark.
[[nodiscard]] const Glyph& glyphOf(char character);

/// Distance from the left side of a glyph to that of the next one.
[[nodiscard]] double advanceOf(char character);

}  // namespace asdfvk
