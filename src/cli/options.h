#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"

namespace asdfvk {

/// How many faces --check takes when it names no number.
inline constexpr uint64_t kDefaultCheckCount = 2000;

/// Reads the arguments after the program's name. Throws Error{Usage} whose line names the option.
[[nodiscard]] CommandLine parseCommandLine(std::vector<std::string> arguments);

/// Three lines for who calls the program without any argument.
[[nodiscard]] std::string shortUsage();

}  // namespace asdfvk
