#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arguments/arguments.h"
#include "cli/other_meshes.h"
#include "cli/outputs.h"
#include "describe/computation_options.h"
#include "describe/session_options.h"

namespace asdfvk {

struct CommandLine {
  /// Paths of meshes, with -r also of folders; "-" (at most once) for standard input.
  std::vector<std::string> meshes;
  SessionSettings session;
  ComputationSettings computation;
  ReadOptions reading;
  OtherMeshes others;
  Outputs outputs;
  BatchOptions batch;
  bool listDevices = false;
  bool deviceReport = false;
  std::string schema;                 ///< The document whose JSON Schema is printed; empty: none.
  std::optional<std::string> answer;  ///< Answer to --help, --version or --print-schema. If set, nothing is computed.
};

/// All options of the program by table, in the order of the help. The line must outlive the rows.
[[nodiscard]] std::vector<OptionRows> optionTables(CommandLine& line);
/// Adds an argument for each row that has a flag. The argument sets the option.
void addArguments(const OptionRows& rows, std::vector<Argument>& arguments);
/// Makes the parser of the program. The options of the parser set `line`.
[[nodiscard]] ArgumentParser parserOf(CommandLine& line);

/// Sets what the given options imply. Throws Error of kind Usage for options that contradict each other or have no
/// effect. Precondition: the given options are set.
void completeLine(CommandLine& line, const GivenOptions& given);

/// Parses the arguments after the name of the program. Throws Error of kind Usage, whose message names the option.
[[nodiscard]] CommandLine parseCommandLine(const std::vector<std::string>& arguments);

/// Throws Error{OptionConflict} with the message.
[[noreturn]] void refuseOptions(const std::string& message);

/// The usage in three lines, for a call without arguments.
[[nodiscard]] std::string shortUsage();

}  // namespace asdfvk
