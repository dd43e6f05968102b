#pragma once

#include <string>
#include <vector>

namespace asdfvk::bench {

/// Where this very program is.
inline const std::string kThisProgram = "/proc/self/exe";

/// Runs a program and returns what it wrote to standard output. Throws Error{Cancelled} when it was interrupted,
/// Error{Input} when it ended with another exit code than 0.
[[nodiscard]] std::string outputOf(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace asdfvk::bench
