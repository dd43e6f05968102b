#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asdfvk {

/// A JSON value that several records share; a null pointer is JSON's null.
using SharedJson = std::shared_ptr<const nlohmann::ordered_json>;

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
  std::optional<uint64_t> faceCount;               ///< Input faces.
  SharedJson options;                              ///< The key "options" of the JSON report.
  std::string version, commit, device, backend;
  std::vector<std::pair<std::string, double>> seconds;  ///< Name and time of each stage that ran.
  double totalSeconds = 0;                              ///< From the start of reading to the end of writing.
  uint64_t peakMemoryBytes = 0;
  SharedJson estimatedError;  ///< The key of the JSON report.
  std::optional<uint32_t> segmentCount;
  std::vector<std::string> warnings;  ///< The codes of the warnings.
  MeshStatus status = MeshStatus::Done;
  int code = 0;         ///< The exit code of this mesh.
  std::string error;    ///< Name of the error; empty without a failure.
  std::string message;  ///< One line; empty without a failure.
};

/// The current time in ISO 8601, "2026-05-31T12:34:56.789Z". The alphabetical order of such texts is that of the times.
[[nodiscard]] std::string utcTime();

[[nodiscard]] nlohmann::ordered_json toJson(const MeshRecord& record);

/// One line without the line end. Bytes that are not UTF-8 are replaced. If the input has such bytes, the key
/// inputBytes has all bytes of the input as hexadecimal digits.
[[nodiscard]] std::string toJsonLine(const MeshRecord& record);

/// Unset where the text is not a record, for example an incomplete line. Only the keys input, status, code and message
/// are required, so that other programs can write records. Unknown keys are ignored.
[[nodiscard]] std::optional<MeshRecord> parseRecord(std::string_view json);
/// The inverse of toJson(); unset where the value is not a record.
[[nodiscard]] std::optional<MeshRecord> recordOf(const nlohmann::ordered_json& json);

}  // namespace asdfvk
