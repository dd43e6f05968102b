#pragma once

#include <string>
#include <vector>

namespace asdfvk::bench {

/// Runs this very program again with other arguments and returns what it wrote to standard output. Throws
/// Error{Cancelled} when it was interrupted, Error{Input} when it ended with another exit code than 0.
[[nodiscard]] std::string outputOfThisProgram(const std::vector<std::string>& arguments);

}  // namespace asdfvk::bench
