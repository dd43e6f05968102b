#include "core/html_text.h"

#include <cstddef>
#include <cstdint>

namespace asdfvk {
namespace {

/// Bytes of the UTF-8 character at the start of the text; 0 if the text does not start with a valid character. Overlong
/// forms, surrogates and code points above U+10FFFF are invalid.
size_t characterSize(std::string_view text) {
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

}  // namespace

std::string escapedForHtml(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const size_t size = characterSize(text);
    const char c = text.front();
    if (size == 0) {
      result += "\xef\xbf\xbd";
    } else if (size > 1) {
      result += text.substr(0, size);
    } else if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else if (c == '\'') {
      result += "&#39;";
    } else {
      result += (static_cast<uint8_t>(c) < 0x20 && c != '\n') || c == 0x7f ? ' ' : c;
    }
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return result;
}

std::string escapedForScript(std::string_view json) {
  std::string result;
  result.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      result += "\\u003c";
    } else if (c == '>') {
      result += "\\u003e";
    } else if (c == '&') {
      result += "\\u0026";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace asdfvk
