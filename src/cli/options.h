#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/session.h"
#include "cli/batch_options.h"
#include "render/camera.h"

namespace asdfvk {

/// The parsed command line. Every option, and every combination of options, is validated.
struct CommandLine {
  std::vector<std::string> meshes;  ///< Paths, "-" for standard input (at most once); with -r also folders.
  SessionOptions session;
  Recipe recipe = Recipe::Balanced;  ///< Applied to `options` before other options.
  Options options;
  std::optional<double> failIfThinner;             ///< Also thickness.thinnerThan; exit code by its verdict.
  std::string output;                              ///< A file, a directory, "-"; empty: beside each input.
  std::string format;                              ///< A name of outputFormats(); empty: by `output`, else ply.
  std::vector<std::string> fields{"sdf", "seed"};  ///< Fields to write, in this order.
  std::string picture;                             ///< A .png, "-" for standard output; empty: none.
  std::string pictureOf = "sdf";                   ///< Name of the field to show; empty: the thin places.
  View pictureView;
  bool choosesView = false;    ///< --picture-view is given.
  std::string valueOptions;    ///< Those given that need values: --postprocess, --segment, or both with "and".
  std::string points;          ///< A .ply for the skeleton points, "-" for standard output; empty: none.
  bool choosesFields = false;  ///< --fields is given.
  bool opensPage = false;      ///< Start the browser with the page.
  BatchOptions batch;
  std::string against;  ///< Of `compared`: the text of --against.
  bool ascii = false;
  bool json = false;
  bool quiet = false;
  bool listDevices = false;
  bool deviceReport = false;
  uint32_t threadCount = 0;           ///< 0: the number of cores.
  std::optional<std::string> answer;  ///< The text of --help or --version; if set, nothing is computed.
  /// Empty, or the same command line with the options of the computation of --against.
  std::vector<CommandLine> compared;
};

/// Number of faces of --check without a value.
inline constexpr uint64_t kDefaultCheckCount = 2000;

/// Reads the arguments after the name of the program. Throws Error of kind Usage; the message contains the name of the
/// option.
[[nodiscard]] CommandLine parseCommandLine(std::vector<std::string> arguments);

/// The values of the options that affect the result: the key "options" of the JSON report.
[[nodiscard]] nlohmann::ordered_json optionValues(const CommandLine& line);

/// Three lines, for a call without arguments.
[[nodiscard]] std::string shortUsage();

}  // namespace asdfvk
