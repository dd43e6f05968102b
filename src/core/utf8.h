#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace asdfvk {

/// U+FFFD, which replaces bytes that are not UTF-8.
inline constexpr std::string_view kReplacementCharacter = "\xef\xbf\xbd";

/// Bytes of the UTF-8 character at the start of the text; 0 if the text does not start with a valid character. Overlong
/// forms, surrogates and code points above U+10FFFF are invalid.
[[nodiscard]] inline size_t utf8CharacterSize(std::string_view text) {
  const auto byteAt = [&](size_t i) { return i < text.size() ? static_cast<uint8_t>(text[i]) : uint8_t{0}; };
  const auto continues = [&](size_t i) { return (byteAt(i) & 0xc0) == 0x80; };
  const uint8_t lead = byteAt(0), second = byteAt(1);
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead <= 0xdf) return continues(1) ? 2 : 0;
  if (lead >= 0xe0 && lead <= 0xef) {
    const bool isValid = continues(1) && !(lead == 0xe0 && second < 0xa0) && !(lead == 0xed && second >= 0xa0);
    return isValid && continues(2) ? 3 : 0;
  }
  if (lead >= 0xf0 && lead <= 0xf4) {
    const bool isValid = continues(1) && !(lead == 0xf0 && second < 0x90) && !(lead == 0xf4 && second >= 0x90);
    return isValid && continues(2) && continues(3) ? 4 : 0;
  }
  return 0;
}

}  // namespace asdfvk
