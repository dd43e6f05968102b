#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json.h"

namespace asdfvk {

enum class MeshStatus {
  Done,
  Skipped,  ///< The output of an earlier run is up to date, see findFinishedOutput().
  Failed,
  Dropped,  ///< The run was cancelled after this mesh was begun and before it was finished.
};
inline constexpr std::array<std::pair<MeshStatus, const char*>, 4> kMeshStatuses{{{MeshStatus::Done, "done"},
                                                                                  {MeshStatus::Skipped, "skipped"},
                                                                                  {MeshStatus::Failed, "failed"},
                                                                                  {MeshStatus::Dropped, "dropped"}}};
[[nodiscard]] const char* nameOf(MeshStatus status);

/// The record of a mesh of a batch: a line of the log, and the content of the file beside the output.
struct MeshRecord {
  std::string input;
  /// utcTime() at the start of the mesh; at the end of its worker process if that was killed; empty where unknown.
  std::string time;
  std::optional<std::string> output;               ///< Unset where no output was written.
  std::string inputHash, optionsHash, outputHash;  ///< contentHash() of each; empty where unknown.
  /// Keys of the JSON report, without lists of places; null or unset where unknown.
  std::optional<uint64_t> faceCount, vertexCount, componentCount, noValueCount;
  std::optional<uint32_t> segmentCount;
  std::string unit;
  Json sdf, thickness, parts, estimatedError, options;
  std::string version, commit, device, backend;
  std::map<std::string, double> seconds;  ///< Time of each stage that ran.
  double totalSeconds = 0;                ///< From the start of reading to the end of writing.
  uint64_t peakMemoryBytes = 0;
  std::vector<std::string> warnings;  ///< The codes of the warnings.
  MeshStatus status = MeshStatus::Done;
  int code = 0;         ///< The exit code of this mesh.
  std::string error;    ///< Name of the error; empty without a failure.
  std::string message;  ///< One line; empty without a failure.
};

/// The current time in ISO 8601, "2026-05-31T12:34:56.789Z". The alphabetical order of such texts is that of the times.
[[nodiscard]] std::string utcTime();

[[nodiscard]] Json toJson(const MeshRecord& record);

/// One line without the line end. Bytes that are not UTF-8 are replaced. If the input has such bytes, the key
/// inputBytes has all bytes of the input as hexadecimal digits.
[[nodiscard]] std::string toJsonLine(const MeshRecord& record);

/// Unset where the text is not a record, for example an incomplete line. Only the keys input, status, code and message
/// are required, so that other programs can write records. Unknown keys are ignored.
[[nodiscard]] std::optional<MeshRecord> parseRecord(std::string_view json);

void to_json(Json& json, MeshStatus status);
void from_json(const Json& json, MeshStatus& status);
ASDFVK_JSON(MeshRecord, input, status, code, error, message, warnings, faceCount, vertexCount, componentCount,
            noValueCount, segmentCount, unit, sdf, thickness, parts, estimatedError, totalSeconds, seconds,
            peakMemoryBytes, backend, device, output, time, version, commit, inputHash, optionsHash, outputHash,
            options)

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
