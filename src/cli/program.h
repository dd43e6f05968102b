#pragma once

#include <string>
#include <vector>

#include "cli/exit_code.h"

namespace asdfvk {

/// Runs asdf-vk. arguments: without the name of the program. Throws nothing; prints a failure as one line.
[[nodiscard]] ExitCode runProgram(const std::vector<std::string>& arguments);

}  // namespace asdfvk
