#pragma once

#include <string>
#include <vector>

#include "arguments/arguments.h"
#include "cli/exit_code.h"

namespace asdfvk {

/// The first argument of `asdf-vk summarize LOG.jsonl...`.
inline constexpr const char* kSummarizeCommand = "summarize";

struct SummaryOptions {
  std::vector<std::string> logs;
  std::string output = "-", format;
  bool isJson = false;
};

/// Name, description and every option of the command, which set `options`.
void addOptions(ArgumentParser& parser, SummaryOptions& options);

/// Reads logs of batches and prints a table, JSON or CSV. arguments: those after the command. Throws
/// Error.
[[nodiscard]] ExitCode summarize(std::vector<std::string> arguments);

}  // namespace asdfvk
