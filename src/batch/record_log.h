#pragma once

#include <filesystem>
#include <mutex>

#include "batch/mesh_record.h"

namespace asdfvk {

/// A file with one record per line. Several threads and several processes may append to it. Each line is written by one
/// write(), so that a killed process leaves at most one incomplete line. The next append() of any process ends that
/// line.
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

/// The records of a log, without their options. Adds to invalidCount the number of lines that are not records, such as
/// incomplete lines. Throws Error{UnreadableInput}.
[[nodiscard]] std::vector<MeshRecord> readLog(const std::filesystem::path& path, size_t& invalidCount);

}  // namespace asdfvk
