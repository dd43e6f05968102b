#pragma once

#include <array>

#include "asdf_vk/error.h"

namespace asdfvk {

struct ErrorKindRow {
  const char* name;
  int code;  ///< Exit code of the program, and status of the interface in C.
};

[[nodiscard]] constexpr ErrorKindRow rowOf(ErrorKind kind) {
  constexpr std::array<ErrorKindRow, 5> kRows{
      {{"usage", 1}, {"input", 2}, {"device", 3}, {"output", 4}, {"cancelled", 130}}};
  static_assert(static_cast<size_t>(ErrorKind::Cancelled) + 1 == kRows.size());
  return kRows[static_cast<size_t>(kind)];
}

}  // namespace asdfvk
