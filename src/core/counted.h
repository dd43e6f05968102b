#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace asdfvk {

/// "1 vertex", "2 vertices"; the plural is the singular and an s where none is given.
[[nodiscard]] inline std::string counted(uint64_t count, std::string_view singular, std::string_view plural = {}) {
  if (count == 1) return fmt::format("1 {}", singular);
  return plural.empty() ? fmt::format("{} {}s", count, singular) : fmt::format("{} {}", count, plural);
}

}  // namespace asdfvk
