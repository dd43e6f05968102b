#pragma once

#include <filesystem>

namespace asdfvk {

/// A new empty folder for temporary files. The destructor removes it.
class TemporaryFolder {
 public:
  /// Throws Error{OutputNotWritable}.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace asdfvk
