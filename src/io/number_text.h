#pragma once

#include <charconv>
#include <cmath>
#include <cstring>

namespace asdfvk {

/// Room for any number that appendNumber() writes.
inline constexpr size_t kNumberTextSize = 32;

/// Writes the shortest text that reads back as the same number ("nan" whatever its sign); returns the end.
template <typename T>
[[nodiscard]] char* appendNumber(char* to, T value) {
  if constexpr (std::is_floating_point_v<T>) {
    if (std::isnan(value)) {
      std::memcpy(to, "nan", 3);
      return to + 3;
    }
  }
  return std::to_chars(to, to + kNumberTextSize, value).ptr;
}

}  // namespace asdfvk
