#pragma once

#include <string>

namespace asdfvk {

/// A new empty folder for temporary files. The destructor removes it.
class TemporaryFolder {
 public:
  /// Throws Error{OutputNotWritable}.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace asdfvk
