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
  Skipped,  ///< The output of an earlier run is up to date; see findFinishedOutput().
  Failed,
  Dropped,  ///< The run was cancelled while this mesh was computed.
};
inline constexpr std::array<std::pair<const char*, MeshStatus>, 4> kMeshStatuses{{{"done", MeshStatus::Done},
                                                                                  {"skipped", MeshStatus::Skipped},
                                                                                  {"failed", MeshStatus::Failed},
                                                                                  {"dropped", MeshStatus::Dropped}}};
constexpr const char* enumerationName(MeshStatus) { return "MeshStatus"; }
constexpr const auto& choicesOf(MeshStatus) { return kMeshStatuses; }
[[nodiscard]] const char* nameOf(MeshStatus status);

/// Record of a mesh of a batch: a line of the log, and the content of the file beside the output.
struct MeshRecord {
  int formatVersion = kJsonFormatVersion;  ///< Version of the format of JSON documents.
  std::string input;                       ///< Path of the mesh.
  /// Bytes of the path as hexadecimal digits; exists only if the path is not valid UTF-8.
  OptionalKey<std::string> inputBytes;
  std::string key;  ///< Name of the mesh in a list or a tar; empty without one.
  /// utcTime() when the computation began, or when a failed worker process ended; empty if unknown.
  std::string time;
  std::optional<std::string> output;               ///< Path of the result; unset if no output was written.
  std::optional<std::string> picture;              ///< Path of the picture; unset if no picture was written.
  std::string inputHash, optionsHash, outputHash;  ///< XXH3 hashes of input, options and output; empty if unknown.
  /// Value of the JSON report; unset if unknown.
  std::optional<uint64_t> faceCount, vertexCount, componentCount, noValueCount;
  std::optional<uint32_t> segmentCount;  ///< Value of the JSON report; unset if unknown.
  std::string unit;                      ///< Value of the JSON report.
  /// Value of the JSON report without lists, except for points and findings; null if unknown.
  Json sdf, thickness, parts, estimatedError, findings, options;
  std::string version, commit, device, backend;  ///< Value of the JSON report; empty if unknown.
  std::map<std::string, double> seconds;         ///< Seconds of each stage that ran.
  double totalSeconds = 0;                       ///< Time from the start of reading to the end of writing, in seconds.
  uint64_t peakMemoryBytes = 0;                  ///< Greatest resident memory of the process, in bytes.
  uint32_t attemptCount = 1;                     ///< 2 if the first worker process was killed for its memory.
  std::vector<std::string> warnings;             ///< Codes of the warnings.
  MeshStatus status = MeshStatus::Done;          ///< What became of the mesh.
  int code = 0;                                  ///< Exit code of this mesh.
  std::string error;                             ///< Name of the error; null without a failure.
  std::string message;                           ///< The reason of the failure in one line; empty without a failure.
};

/// The values of MeshRecord::error that are verdicts of checks on a computed mesh, and what a summary calls such
/// meshes.
inline constexpr std::array<std::pair<const char*, const char*>, 6> kVerdictErrors{
    {{"tooThin", "thin"},
     {"tooThick", "thick"},
     {"tooClose", "with narrow gaps"},
     {"sealedVoids", "with sealed voids"},
     {"bodiesInContact", "with bodies in contact"},
     {"notJudged", "not judged"}}};
[[nodiscard]] bool hasVerdictError(const MeshRecord& record);

/// Returns the current time in ISO 8601, for example "2026-05-31T12:34:56.789Z". The alphabetical order of these texts
/// is the order of the times.
[[nodiscard]] std::string utcTime();

[[nodiscard]] Json toJson(const MeshRecord& record);

/// The record as one line of JSON, without the line end. Invalid UTF-8 is replaced. If MeshRecord::input is not UTF-8,
/// the key inputBytes has its bytes in hexadecimal digits.
[[nodiscard]] std::string toJsonLine(const MeshRecord& record);

/// Parses a record. Returns nothing if the text is not a record, for example an incomplete line. Only the keys input,
/// status, code and message are required, so that other programs can write records. Ignores unknown keys.
[[nodiscard]] std::optional<MeshRecord> parseRecord(std::string_view json);

void to_json(Json& json, MeshStatus status);
void from_json(const Json& json, MeshStatus& status);
ASDFVK_JSON(MeshRecord, formatVersion, input, inputBytes, key, status, code, error, message, warnings, faceCount,
            vertexCount, componentCount, noValueCount, segmentCount, unit, sdf, thickness, parts, estimatedError,
            findings, totalSeconds, seconds, peakMemoryBytes, attemptCount, backend, device, output, picture, time,
            version, commit, inputHash, optionsHash, outputHash, options)

/// A file with one record per line, to which several threads and processes may append. Each line is written by one
/// write(). A killed process leaves at most one incomplete line. The next append() of any process ends this line.
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

/// Reads the records of a log, without MeshRecord::options. Adds the number of lines that are not records, such as
/// incomplete lines, to invalidCount. Throws Error{UnreadableInput}.
[[nodiscard]] std::vector<MeshRecord> readLog(const std::filesystem::path& path, size_t& invalidCount);

}  // namespace asdfvk
