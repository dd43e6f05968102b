#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "arguments/arguments.h"
#include "cli/exit_code.h"
#include "cli/request_computer.h"

namespace asdfvk {

/// Names of the commands that answer requests on standard input until its end.
inline constexpr const char* kServe = "serve";
inline constexpr const char* kMcp = "mcp";

struct ServerOptions {
  SessionSettings session;
  std::string root;             ///< Folder of the files; empty: all files, in `mcp` the current folder.
  uint64_t maxMemoryBytes = 0;  ///< 0: no limit.
  double timeoutSeconds = std::numeric_limits<double>::infinity();
  uint32_t jobCount = 0;  ///< Requests that are computed at once; 0: the number of cores.
};

/// Makes the parser of the command. The options of the parser set `options`.
[[nodiscard]] ArgumentParser serverParser(std::string_view command, ServerOptions& options);

/// The command `asdf-vk serve` or `asdf-vk mcp`. arguments: those after the name of the command. Throws Error of kind
/// Usage, Input and Output.
[[nodiscard]] ExitCode runServer(std::string_view command, const std::vector<std::string>& arguments);

}  // namespace asdfvk
