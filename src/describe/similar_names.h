#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/api.h"

namespace asdfvk {

/// "--seeds or --rng-seed" for "--seed": at most three names that differ in few letters, or one of whose words begins
/// with the name. Empty where there is none.
[[nodiscard]] ASDFVK_API std::string similarNames(std::string_view name, const std::vector<std::string>& names);

}  // namespace asdfvk
