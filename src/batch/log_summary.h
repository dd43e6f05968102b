#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "batch/mesh_record.h"

namespace asdfvk {

/// Distribution of numbers; all 0 if there are no numbers.
struct Spread {
  double min = 0, median = 0, percentile90 = 0, max = 0;  ///< Minimum, median, 90th percentile and maximum.
};
ASDFVK_JSON(Spread, min, median, percentile90, max)
[[nodiscard]] Spread spreadOf(std::vector<double> numbers);

/// Meshes that failed or were dropped with the same code and error.
struct FailureGroup {
  MeshStatus status = MeshStatus::Failed;    ///< See the records.
  int code = 0;                              ///< Exit code of each mesh.
  std::string error;                         ///< Name of the error.
  uint64_t count = 0;                        ///< Meshes of the group.
  std::string exampleInput, exampleMessage;  ///< Path and message of one of the meshes.
};

ASDFVK_JSON(FailureGroup, status, code, error, count, exampleInput, exampleMessage)

/// Meshes with the same warning.
struct WarningGroup {
  std::string code;                 ///< Code of the warning.
  uint64_t count = 0;               ///< Meshes with the warning.
  std::vector<std::string> inputs;  ///< Paths of the meshes.
};

ASDFVK_JSON(WarningGroup, code, count, inputs)

/// Counts, times and failures from the logs of a batch. If a mesh has several records, the record with the latest time
/// counts. If the times are equal or missing, the last record counts.
struct LogSummary {
  size_t recordCount = 0, invalidLineCount = 0;
  std::map<MeshStatus, uint64_t> statusCounts;
  uint64_t faceCount = 0;  ///< Sum over the computed meshes, which have the status Done or Skipped.
  double meshSeconds = 0;  ///< Sum of the total times of the computed meshes.
  /// Total times of the computed meshes, and their estimated average errors divided by the range of the values.
  Spread seconds, averageErrors;
  uint64_t peakMemoryBytes = 0;                              ///< Maximum over all meshes.
  std::vector<std::pair<std::string, double>> stageSeconds;  ///< Seconds of each stage; the longest stage first.
  std::vector<FailureGroup> failures;                        ///< By descending count.
  std::vector<WarningGroup> warnings;                        ///< By descending count.
  std::vector<std::pair<std::string, uint64_t>> devices;     ///< Devices, and their numbers of meshes.
  std::vector<MeshRecord> meshes;                            ///< The latest record of each mesh, sorted by input.
};

/// What `asdf-vk summarize --format json` prints.
struct SummaryDocument {
  int formatVersion = kJsonFormatVersion;                       ///< Version of the format of JSON documents.
  uint64_t meshCount;                                           ///< Meshes; several records may be of one mesh.
  uint64_t recordCount, invalidLineCount;                       ///< Records, and lines that are no records.
  uint64_t doneCount, skippedCount, failedCount, droppedCount;  ///< Meshes with this status.
  uint64_t faceCount;                                           ///< Faces of the computed and skipped meshes.
  double meshSeconds;                                           ///< Sum of the seconds of these meshes.
  Spread seconds;                                               ///< Seconds per mesh.
  Spread averageError;                                          ///< Estimated average errors, divided by the range.
  uint64_t peakMemoryBytes;                                     ///< Greatest memory of a process.
  std::vector<std::pair<std::string, double>> stageSeconds;     ///< Seconds of each stage; the longest stage first.
  std::vector<std::pair<std::string, uint64_t>> devices;        ///< Devices, and their numbers of meshes.
  std::vector<WarningGroup> warnings;                           ///< Warnings; the most frequent one first.
  std::vector<FailureGroup> failures;                           ///< Failures; the most frequent one first.
};
ASDFVK_JSON_KEYS(SummaryDocument, formatVersion, meshCount, recordCount, invalidLineCount, doneCount, skippedCount,
                 failedCount, droppedCount, faceCount, meshSeconds, seconds, averageError, peakMemoryBytes,
                 stageSeconds, devices, warnings, failures)

[[nodiscard]] LogSummary summarizeRecords(std::vector<MeshRecord> records, size_t invalidLineCount);

[[nodiscard]] std::string textOf(const LogSummary& summary);
[[nodiscard]] std::string jsonOf(const LogSummary& summary);
/// A table in CSV (RFC 4180): a row of column names, then a row per mesh. The columns are the keys of the records,
/// without options and hashes. A key of an object has the name of the object as prefix: "sdf.median". Objects that no
/// mesh has are left out. Warnings of a mesh are separated by spaces.
[[nodiscard]] std::string csvOf(const LogSummary& summary);

}  // namespace asdfvk
