#pragma once

#include <filesystem>

#include "pipeline/asdf.h"

namespace asdfvk::bench {

struct FileRun {
  Report report;  ///< With the times of reading and writing.
  double totalSeconds = 0;
};

/// What the command line does with a mesh: reads it, computes, writes `output`.
[[nodiscard]] FileRun runFile(Session& session, const std::filesystem::path& mesh, const Options& options,
                              const std::filesystem::path& output, const RunControl& control);

/// Throws Error{Usage} for a name other than "vulkan", "cpu" and "reference". `device` is for Vulkan.
[[nodiscard]] SessionOptions sessionOptionsOf(const std::string& backend, const std::string& device);

}  // namespace asdfvk::bench
