#pragma once

#include <string>
#include <vector>

#include "cli/exit_code.h"

namespace asdfvk {

/// Runs the program asdf-vk. arguments: without the name of the program. Throws nothing; prints a failure as one line
/// on standard error.
[[nodiscard]] ExitCode runProgram(const std::vector<std::string>& arguments);

}  // namespace asdfvk
