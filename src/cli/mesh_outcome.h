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

}  // namespace asdfvk
