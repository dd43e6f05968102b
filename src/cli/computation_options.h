#pragma once

#include <CLI/CLI.hpp>

#include "cli/command_line.h"

namespace asdfvk {

/// Groups of --help=all. --help shows the first one only.
inline constexpr const char* kBasicGroup = "Options";
inline constexpr const char* kExperimentGroup = "Experiments (the defaults are best)";

/// Seeds of the first round where further rounds may follow and --seeds is not given, as a share.
inline constexpr double kFirstRoundShare = 0.02;

/// Adds the options of the computation, which set line.options and line.recipe.
void addComputation(CLI::App& app, CommandLine& line);

}  // namespace asdfvk
