#pragma once

#include <string>

namespace asdfvk {

struct PageFailure {
  std::string code;     ///< nameOf(ErrorCode), or "internal".
  std::string message;  ///< The reason and the remedy, in one line.
};

/// Describes the current exception. Precondition: called in a catch block.
[[nodiscard]] PageFailure currentPageFailure();

}  // namespace asdfvk
