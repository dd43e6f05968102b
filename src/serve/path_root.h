#pragma once

#include <filesystem>
#include <string>

#include "asdf_vk/error.h"

namespace asdfvk {

/// Limits requests to the files below a folder.
class PathRoot {
 public:
  /// All files are allowed.
  PathRoot() = default;
  /// Throws Error{UnreadableInput} if the folder does not exist.
  explicit PathRoot(const std::filesystem::path& folder);

  /// The folder without links; empty if all files are allowed.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// The path of the file; with a folder, without links and "..", where a relative path is relative to the folder. The
  /// file need not exist. Throws Error{refusal} for a file that is not below the folder, for a path that cannot be
  /// resolved, and for "-", because requests use the standard streams.
  [[nodiscard]] std::string resolved(const std::string& path, ErrorCode refusal) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace asdfvk
