#pragma once

#include <cstdint>
#include <string_view>

#include "io/text_scanner.h"

namespace asdfvk {

/// What the keyword of an OFF file says about the numbers behind the coordinates of each vertex.
struct OffHeader {
  std::string_view keyword = "OFF";
  bool hasColours = false;  ///< 3 or 4 numbers.
  bool hasNormals = false;  ///< 3 numbers.
  bool hasTexture = false;  ///< 2 numbers.

  [[nodiscard]] bool allowsExtraCount(uint64_t count) const {
    const uint64_t sure = (hasNormals ? 3u : 0u) + (hasTexture ? 2u : 0u);
    return hasColours ? count == sure + 3 || count == sure + 4 : count == sure;
  }
};

/// Whether `word` is an OFF keyword, alone or with a digit right behind it ("OFF3 1 0" is found in the wild).
[[nodiscard]] bool isOffKeyword(std::string_view word);

/// Reads up to the counts. A file may do without the keyword and begin with its counts.
[[nodiscard]] OffHeader readOffHeader(TextScanner& text);

}  // namespace asdfvk
