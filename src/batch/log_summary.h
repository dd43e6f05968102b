#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "batch/mesh_record.h"

namespace asdfvk {

/// Minimum, median, 90th percentile and maximum of some numbers; all 0 if there are none.
struct Spread {
  double min = 0, median = 0, percentile90 = 0, max = 0;
};
ASDFVK_JSON(Spread, min, median, percentile90, max)
[[nodiscard]] Spread spreadOf(std::vector<double> numbers);

/// Meshes that failed, or were dropped, with the same code and error.
struct FailureGroup {
  MeshStatus status = MeshStatus::Failed;
  int code = 0;
  std::string error;
  uint64_t count = 0;
  std::string exampleInput, exampleMessage;
};

ASDFVK_JSON(FailureGroup, status, code, error, count, exampleInput, exampleMessage)

/// The meshes that have a warning.
struct WarningGroup {
  std::string code;
  uint64_t count = 0;
  std::vector<std::string> inputs;  ///< The inputs of all of these meshes.
};

ASDFVK_JSON(WarningGroup, code, count, inputs)

/// Counts, times and failures from the logs of a batch. If a mesh has several records, the one with the latest time
/// counts; of equal times, or without times, the last one.
struct LogSummary {
  size_t recordCount = 0, invalidLineCount = 0;
  std::map<MeshStatus, uint64_t> statusCounts;
  uint64_t faceCount = 0;         ///< Sum over the meshes that were computed, also by earlier runs.
  double meshSeconds = 0;         ///< Sum of their times.
  Spread seconds, averageErrors;  ///< Over these meshes: total times; estimated average errors, shares of the range.
  uint64_t peakMemoryBytes = 0;   ///< The greatest.
  std::vector<std::pair<std::string, double>> stageSeconds;  ///< Sums, descending.
  std::vector<FailureGroup> failures;                        ///< By descending count.
  std::vector<WarningGroup> warnings;                        ///< By descending count.
  std::vector<std::pair<std::string, uint64_t>> devices;     ///< Meshes by device.
  std::vector<MeshRecord> meshes;                            ///< One record per mesh, the latest, sorted by input.
};

[[nodiscard]] LogSummary summarizeRecords(std::vector<MeshRecord> records, size_t invalidLineCount);

/// Aligned lines.
[[nodiscard]] std::string textOf(const LogSummary& summary);
/// One document.
[[nodiscard]] std::string jsonOf(const LogSummary& summary);
/// A table with a row for each mesh, after a row of names (RFC 4180): the keys of the records without options and
/// hashes. The keys of an object follow its own after a dot, "sdf.median". Keys of an object that no mesh has are left
/// out. Warnings of a mesh are separated by spaces.
[[nodiscard]] std::string csvOf(const LogSummary& summary);

}  // namespace asdfvk
