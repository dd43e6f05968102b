#pragma once

#include <filesystem>
#include <mutex>

#include "batch/mesh_record.h"

namespace asdfvk {

/// A file with a record per line, to which several threads and several processes append. Each line is one write(), so
/// that a killed process leaves at most a cut line, which the next append() of any process ends.
class RecordLog {
 public:
  /// Throws Error{OutputNotWritable}.
  explicit RecordLog(const std::filesystem::path& path);
  ~RecordLog();
  RecordLog(const RecordLog&) = delete;
  RecordLog& operator=(const RecordLog&) = delete;

  /// Throws Error{OutputNotWritable}.
  void append(const MeshRecord& record);

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::mutex mutex_;
};

/// The records of a log without their options; invalidCount: lines that are none, such as cut ones. Throws
/// Error{UnreadableInput}.
[[nodiscard]] std::vector<MeshRecord> readLog(const std::filesystem::path& path, size_t& invalidCount);

}  // namespace asdfvk
