#include "core/html_text.h"

#include <cstddef>
#include <cstdint>

#include "core/utf8.h"

namespace asdfvk {

std::string escapedForHtml(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const size_t size = utf8CharacterSize(text);
    const char c = text.front();
    if (size == 0) {
      result += kReplacementCharacter;
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
