#pragma once

#include <string>
#include <vector>

namespace asdfvk::bench {

struct ProcessUsage {
  double seconds = 0;
  double cpuSeconds = 0;  ///< CPU seconds of all threads, including time in the kernel.
  double peakBytes = 0;   ///< Peak resident memory, including shared libraries and mapped files.
};

/// Returns the standard output. Throws Error{Cancelled} for kCancelledExitCode, std::runtime_error for other failures.
[[nodiscard]] std::string outputOf(const std::string& program, const std::vector<std::string>& arguments,
                                   ProcessUsage* usage = nullptr);

}  // namespace asdfvk::bench
