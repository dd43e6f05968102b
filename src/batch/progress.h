#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "batch/mesh_record.h"

namespace asdfvk {

/// Counts of a running batch, for estimates of its rate and its remaining time. Bytes refer to the input files.
struct BatchProgress {
  uint64_t meshCount = 0, byteCount = 0;  ///< Meshes of the whole batch, and bytes of their files; 0: unknown.
  uint64_t doneCount = 0, skippedCount = 0, failedCount = 0, droppedCount = 0;
  uint64_t skippedVerdictCount = 0;  ///< Skipped meshes whose verdict of an earlier run is not OK.
  uint64_t doneBytes = 0;            ///< Bytes of the meshes that were computed or failed.
  uint64_t skippedBytes = 0;
  uint64_t faceCount = 0;  ///< Faces of the meshes that were computed.
  bool isCheck = false;    ///< The summary calls meshes "ok" instead of "done".
  std::map<std::string, uint64_t>
      failures;  ///< Numbers of meshes that failed in this run or an earlier one, by what happened, in words.

  void count(const MeshRecord& record, uint64_t bytes);

  [[nodiscard]] uint64_t finishedCount() const { return doneCount + skippedCount + failedCount + droppedCount; }
  /// Finished share of the batch, 0 to 1, by bytes and number of meshes.
  [[nodiscard]] double share() const;
  /// Estimated from the bytes and the number of meshes that were computed or failed; infinite if there is no such mesh.
  [[nodiscard]] double secondsLeft(double elapsedSeconds) const;
};

/// The progress in one line: "1,234 of 10,000 meshes, 56.7 meshes/s, 2 min 35 s left, 12 failed".
[[nodiscard]] std::string progressText(const BatchProgress& progress, double elapsedSeconds);

/// The summary in one line: "9,899 ok, 3 skipped, 2 thin, 1 not judged, 3 unreadable; 123 s, 80.5 meshes/s, 0.312
/// million faces/s".
[[nodiscard]] std::string summaryText(const BatchProgress& progress, double elapsedSeconds);

/// A duration as a text: "35 s", "2 min 35 s", "3 h 12 min", "2 d 4 h".
[[nodiscard]] std::string durationText(double seconds);

}  // namespace asdfvk
