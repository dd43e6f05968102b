#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "core/run_control.h"

namespace asdfvk::bench {

/// Parses the command line into what was bound to `app`, runs `body`, and tells what it throws on standard error.
/// Ctrl-C asks `body` to stop, so that its temporary files are removed. Returns the exit code, as asdf-vk's are.
[[nodiscard]] int runBenchProgram(CLI::App& app, int argc, char** argv,
                                  const std::function<void(const RunControl&)>& body);

}  // namespace asdfvk::bench
