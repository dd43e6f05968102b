#include "batch/progress.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "batch/input_list.h"
#include "core/text.h"

namespace asdfvk {
namespace {

double weightOf(uint64_t meshes, uint64_t bytes) {
  return static_cast<double>(bytes) + static_cast<double>(kBytesPerMesh * meshes);
}

std::string rateText(uint64_t count, double seconds) {
  return fmt::format("{:.3g} meshes/s", static_cast<double>(count) / std::fmax(seconds, 1e-3));
}

/// What a failure of a mesh is called in a summary.
std::string wordsOf(const MeshRecord& record) {
  constexpr int kUnreadable = 2;
  for (const auto& [error, words] : kVerdictErrors)
    if (record.error == error) return words;
  if (record.error == "checkFailed") return "failed the comparison";
  return record.code == kUnreadable ? "unreadable" : "failed";
}

}  // namespace

void BatchProgress::count(const MeshRecord& record, uint64_t bytes) {
  switch (record.status) {
    case MeshStatus::Skipped:
      ++skippedCount;
      skippedBytes += bytes;
      if (record.error.empty()) return;
      ++skippedVerdictCount;
      ++failures[wordsOf(record)];
      return;
    case MeshStatus::Dropped:
      ++droppedCount;
      return;
    case MeshStatus::Done:
      ++doneCount;
      faceCount += record.faceCount.value_or(0);
      break;
    case MeshStatus::Failed:
      ++failedCount;
      ++failures[wordsOf(record)];
      break;
  }
  doneBytes += bytes;
}

double BatchProgress::share() const {
  const double whole = weightOf(meshCount, byteCount);
  return whole > 0 ? weightOf(finishedCount(), doneBytes + skippedBytes) / whole : 1;
}

double BatchProgress::secondsLeft(double elapsedSeconds) const {
  if (meshCount == 0) return std::numeric_limits<double>::infinity();
  const double computed = weightOf(doneCount + failedCount, doneBytes);
  const double left = weightOf(meshCount - finishedCount(), byteCount - doneBytes - skippedBytes);
  if (left <= 0) return 0;
  return computed > 0 ? elapsedSeconds * left / computed : std::numeric_limits<double>::infinity();
}

std::string durationText(double seconds) {
  const auto whole = static_cast<uint64_t>(std::llround(std::fmax(0, seconds)));
  constexpr uint64_t kMinute = 60, kHour = 60 * kMinute, kDay = 24 * kHour;
  if (whole < kMinute) return fmt::format("{} s", whole);
  if (whole < kHour) return fmt::format("{} min {} s", whole / kMinute, whole % kMinute);
  if (whole < kDay) return fmt::format("{} h {} min", whole / kHour, whole % kHour / kMinute);
  return fmt::format("{} d {} h", whole / kDay, whole % kDay / kHour);
}

std::string progressText(const BatchProgress& progress, double elapsedSeconds) {
  const std::string ofAll = progress.meshCount == 0 ? "" : " of " + groupDigits(progress.meshCount);
  std::string text = fmt::format("{}{} meshes, {}", groupDigits(progress.finishedCount()), ofAll,
                                 rateText(progress.doneCount + progress.failedCount, elapsedSeconds));
  const double left = progress.secondsLeft(elapsedSeconds);
  if (std::isfinite(left)) text += fmt::format(", {} left", durationText(left));
  if (progress.skippedCount > 0) text += fmt::format(", {} skipped", groupDigits(progress.skippedCount));
  if (progress.failedCount > 0) text += fmt::format(", {} failed", groupDigits(progress.failedCount));
  return text;
}

std::string summaryText(const BatchProgress& progress, double elapsedSeconds) {
  std::string text = fmt::format("{} {}", groupDigits(progress.doneCount), progress.isCheck ? "ok" : "done");
  const auto add = [&](uint64_t count, const std::string& status) {
    if (count > 0) text += fmt::format(", {} {}", groupDigits(count), status);
  };
  add(progress.skippedCount - progress.skippedVerdictCount, "skipped");
  for (const auto& [words, count] : progress.failures) add(count, words);
  add(progress.droppedCount, "dropped");
  if (progress.meshCount > 0) add(progress.meshCount - progress.finishedCount(), "not begun");
  text += fmt::format("; {:.3g} s", elapsedSeconds);
  const uint64_t computedCount = progress.doneCount + progress.failedCount;
  if (computedCount > 0)
    text += fmt::format(", {}, {:.3g} million faces/s", rateText(computedCount, elapsedSeconds),
                        static_cast<double>(progress.faceCount) / 1e6 / std::fmax(elapsedSeconds, 1e-3));
  return text;
}

}  // namespace asdfvk
