#pragma once

#include <memory>
#include <string>

// The temporary files that this process is writing, for a signal handler.
namespace asdfvk {

/// An entry in the list of removeUnfinishedFiles().
class UnfinishedFile {
 public:
  UnfinishedFile() = default;
  ~UnfinishedFile() { withdraw(); }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Adds the file to the list, unless the list is full. Precondition: this object has no file in the list.
  void announce(const std::string& path);
  void withdraw() noexcept;

 private:
  std::unique_ptr<char[]> path_;  ///< Null for a file that is not in the list.
};

/// Removes the temporary files that this process is writing, at most 64. Async-signal-safe, for a signal handler that
/// then ends the process.
void removeUnfinishedFiles() noexcept;

}  // namespace asdfvk
