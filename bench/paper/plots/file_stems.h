#pragma once

#include <string>
#include <vector>

namespace asdfvk::bench {

/// Names for what is made from files of these paths: their stems with '_' for all but letters, digits, '-', '_' and
/// '.', and with -2, -3 and so on where a name is taken, upper and lower case being the same.
[[nodiscard]] std::vector<std::string> uniqueStems(const std::vector<std::string>& paths);

}  // namespace asdfvk::bench
