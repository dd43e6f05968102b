#pragma once

#include <stdexcept>
#include <string_view>

#include "core/json.h"

namespace asdfvk {

/// Parses JSON that this program or a person has written. Throws std::exception if the text is invalid or nested deeper
/// than 16: to copy and to print a value is recursive, so that deep nesting would overflow the stack. Records, which
/// are nested deepest, have five levels.
[[nodiscard]] inline Json parsedShallowJson(std::string_view text) {
  constexpr int kMaxDepth = 16;
  return Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
    if (depth > kMaxDepth) throw std::length_error("nested too deep");
    return true;
  });
}

}  // namespace asdfvk
