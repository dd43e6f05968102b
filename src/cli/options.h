#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arguments/arguments.h"
#include "cli/outputs.h"
#include "describe/computation_options.h"
#include "describe/report_json.h"

namespace asdfvk {

/// The parsed command line. Every option, and every combination of options, is validated.
struct CommandLine {
  std::vector<std::string> meshes;  ///< Paths, "-" for standard input (at most once); with -r also folders.
  SessionSettings session;
  ComputationSettings computation;
  Outputs outputs;
  BatchOptions batch;
  bool listDevices = false;
  bool deviceReport = false;
  std::optional<std::string> answer;  ///< The text of --help or --version; if set, nothing is computed.
};

/// Rows with the struct that they set.
struct OptionTable {
  OptionRows rows;
  void* target;
};

/// All options of the program, in the order of the help.
[[nodiscard]] std::vector<OptionTable> optionTables(CommandLine& line);
[[nodiscard]] OptionRows outputRows();

/// Name, description and every option of the program, which set `line`.
[[nodiscard]] ArgumentParser parserOf(CommandLine& line);

/// Reads the arguments after the name of the program. Throws Error of kind Usage; the message contains the name of the
/// option.
[[nodiscard]] CommandLine parseCommandLine(const std::vector<std::string>& arguments);

/// Throws Error{OptionConflict}.
[[noreturn]] void refuseOptions(const std::string& message);

/// Hash of all that determines the output of a mesh, for --skip-existing.
[[nodiscard]] std::string optionsHash(const ComputationSettings& computation, const SessionSettings& session,
                                      const Outputs& outputs);

/// Three lines, for a call without arguments.
[[nodiscard]] std::string shortUsage();

}  // namespace asdfvk
