#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace asdfvk {

/// The text with A to Z in lower case, whatever the locale.
[[nodiscard]] inline std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

}  // namespace asdfvk
