#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace asdfvk::bench {

/// What a process took from its start to its end.
struct ProcessUsage {
  double seconds = 0;
  double cpuSeconds = 0;  ///< Of all threads, the kernel included.
  double peakBytes = 0;   ///< Peak resident memory, shared libraries and mapped files included.
};

/// Runs a program and returns its standard output. Throws Error{Cancelled} when its exit code is kCancelledExitCode,
/// std::runtime_error for any other exit code than 0.
[[nodiscard]] std::string outputOf(const std::string& program, const std::vector<std::string>& arguments,
                                   ProcessUsage* usage = nullptr);

/// A new folder under $TMPDIR (default /tmp); the destructor removes it with its contents. Throws Error{Output}.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace asdfvk::bench
