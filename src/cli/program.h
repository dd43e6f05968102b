#pragma once

#include <string>
#include <vector>

#include "cli/exit_code.h"

namespace asdfvk {

/// The program asdf-vk; arguments: without its name. Throws nothing: a failure is one line on standard error.
[[nodiscard]] ExitCode runProgram(const std::vector<std::string>& arguments);

}  // namespace asdfvk
