#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asdfvk {

enum class MeshStatus {
  Done,
  Skipped,  ///< An earlier run computed the output, and nothing has changed.
  Failed,
  Dropped,  ///< The run was cancelled while this mesh was at hand.
};
inline constexpr std::array<std::pair<MeshStatus, const char*>, 4> kMeshStatuses{{{MeshStatus::Done, "done"},
                                                                                  {MeshStatus::Skipped, "skipped"},
                                                                                  {MeshStatus::Failed, "failed"},
                                                                                  {MeshStatus::Dropped, "dropped"}}};
[[nodiscard]] const char* nameOf(MeshStatus status);

/// What a batch records about one mesh: a line of the log, and the file beside the output.
struct MeshRecord {
  std::string input;
  std::string time;                                ///< utcTime() when the mesh was begun; empty where unknown.
  std::optional<std::string> output;               ///< Unset where none was written.
  std::string inputHash, optionsHash, outputHash;  ///< contentHash(); empty where unknown.
  std::optional<uint64_t> faceCount;               ///< Input faces.
  nlohmann::ordered_json options;                  ///< As in the JSON report.
  std::string version, commit, device, backend;
  std::vector<std::pair<std::string, double>> seconds;  ///< Of each stage that ran.
  double totalSeconds = 0;                              ///< From the reading to the end of the writing.
  uint64_t peakMemoryBytes = 0;
  nlohmann::ordered_json estimatedError;  ///< As in the JSON report, or null.
  std::optional<uint32_t> segmentCount;
  std::vector<std::string> warnings;  ///< Their codes.
  MeshStatus status = MeshStatus::Done;
  int code = 0;         ///< The exit code for this mesh.
  std::string error;    ///< Its name; empty without a failure.
  std::string message;  ///< Empty without a failure.
};

/// "2026-05-31T12:34:56.789Z": the current time by ISO 8601, in an order that is that of the texts.
[[nodiscard]] std::string utcTime();

[[nodiscard]] nlohmann::ordered_json toJson(const MeshRecord& record);

/// One line without a line end. Bytes that are not UTF-8 are replaced; for an input with such bytes, the key inputBytes
/// has all of them as hexadecimal digits.
[[nodiscard]] std::string toJsonLine(const MeshRecord& record);

/// Unset where the text is not a record, for example a line that was cut. Needs the keys input, status, code and
/// message only, so that other programs can write records. Unknown keys are ignored.
[[nodiscard]] std::optional<MeshRecord> parseRecord(std::string_view json);

}  // namespace asdfvk
