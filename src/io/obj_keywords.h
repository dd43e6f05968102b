#pragma once

#include <string_view>

namespace asdfvk {

/// Whether OBJ (version 3.0, and what 2.11 had) has a statement of this name.
[[nodiscard]] bool isObjKeyword(std::string_view word);

}  // namespace asdfvk
