#pragma once

#include <CLI/CLI.hpp>

#include "cli/command_line.h"

namespace asdfvk {

/// Where the rounds of --max-error and --time-budget begin when --seeds does not say it.
inline constexpr double kFirstRoundShare = 0.02;

/// The options that decide about values: recipe, seeds, rays, interpolation. What --recipe sets is overruled by the
/// other options, wherever they stand.
void addComputation(CLI::App& app, CommandLine& line);

}  // namespace asdfvk
