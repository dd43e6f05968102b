#pragma once

#include <string>
#include <vector>

#include "cli/exit_code.h"

namespace asdfvk {

/// The whole program but the process: `arguments` are those after its name. Nothing is thrown; what failed is on
/// standard error as one line.
[[nodiscard]] ExitCode runProgram(const std::vector<std::string>& arguments);

}  // namespace asdfvk
