#pragma once

#include <string>
#include <vector>

#include "asdf_vk/options.h"

namespace asdfvk {

/// The fields of a result that are written by default, in this order.
[[nodiscard]] std::vector<std::string> defaultFieldNames(const Options& options);

}  // namespace asdfvk
