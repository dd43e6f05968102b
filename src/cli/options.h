#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/session.h"
#include "cli/batch_options.h"
#include "cli/outputs.h"

namespace asdfvk {

/// What is computed on a mesh.
struct Computation {
  Recipe recipe = Recipe::Balanced;  ///< Applied to `options` before other options.
  Options options;
  std::optional<double> failIfThinner;  ///< Also thickness.thinnerThan; exit code by its verdict.
  std::string valueOptions;             ///< Those given that need values: --postprocess, --segment, or both with "and".
  std::string against;                  ///< The text of --against, if these are its options.
};

/// The parsed command line. Every option, and every combination of options, is validated.
struct CommandLine {
  std::vector<std::string> meshes;  ///< Paths, "-" for standard input (at most once); with -r also folders.
  SessionOptions session;
  Computation computation;
  std::optional<Computation> compared;  ///< That of --against.
  Outputs outputs;
  BatchOptions batch;
  bool listDevices = false;
  bool deviceReport = false;
  uint32_t threadCount = 0;           ///< 0: the number of cores.
  std::optional<std::string> answer;  ///< The text of --help or --version; if set, nothing is computed.
};

/// Number of faces of --check without a value.
inline constexpr uint64_t kDefaultCheckCount = 2000;

/// Reads the arguments after the name of the program. Throws Error of kind Usage; the message contains the name of the
/// option.
[[nodiscard]] CommandLine parseCommandLine(std::vector<std::string> arguments);

/// The values of the options that affect the result: the key "options" of the JSON report.
[[nodiscard]] nlohmann::ordered_json optionValues(const Computation& computation, const SessionOptions& session);

/// Three lines, for a call without arguments.
[[nodiscard]] std::string shortUsage();

}  // namespace asdfvk
