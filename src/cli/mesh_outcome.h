#pragma once

#include <string>

#include "cli/command_line.h"
#include "pipeline/asdf.h"

namespace asdfvk {

/// One computed mesh, as both reports tell it. Views only.
struct MeshOutcome {
  const std::string& mesh;    ///< As on the command line.
  const std::string& output;  ///< Where its result is; "-" for standard output.
  const CommandLine& line;
  const Report& report;
};

/// Whether --check compared traced faces at all and they agree: a check that did not run never passes.
[[nodiscard]] inline bool hasPassed(const CheckReport& check) { return check.tracedCount > 0 && check.passed; }

}  // namespace asdfvk
