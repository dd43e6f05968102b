#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "asdf_vk/run_control.h"
#include "core/stopwatch.h"

namespace asdfvk {

/// Size of the next submission, adapted to the target time. This time is short enough for progress and cancellation,
/// and long enough to hide the cost of a submission.
class ChunkSize {
 public:
  static constexpr double kTargetSeconds = 0.07;
  static constexpr uint64_t kMin = 16;

  ChunkSize(uint64_t first, uint64_t largest, double targetSeconds = kTargetSeconds)
      : size_(std::min(first, largest)), largest_(largest), targetSeconds_(targetSeconds) {}

  [[nodiscard]] uint64_t current() const { return size_; }
  /// seconds: time of a chunk of `count`. The size changes at most fourfold, which bounds the effect of an outlier.
  void adapt(uint64_t count, double seconds) {
    const double ideal = static_cast<double>(count) * targetSeconds_ / std::max(seconds, 1e-6);
    const double bounded = std::clamp(ideal, static_cast<double>(size_) / 4, static_cast<double>(size_) * 4);
    size_ = std::clamp<uint64_t>(static_cast<uint64_t>(bounded), std::min(kMin, largest_), largest_);
  }

 private:
  uint64_t size_, largest_;
  double targetSeconds_;
};

/// Calls work(begin, end) for consecutive ranges of [0, count). There is a checkpoint before each range and one at the
/// end.
template <typename Work>
void forEachChunk(size_t count, ChunkSize size, const RunControl& control, const Work& work) {
  for (size_t begin = 0; begin < count;) {
    control.checkpoint(static_cast<double>(begin) / static_cast<double>(count));
    const size_t end = std::min<size_t>(begin + size.current(), count);
    const Stopwatch stopwatch;
    work(begin, end);
    size.adapt(end - begin, stopwatch.seconds());
    begin = end;
  }
  control.checkpoint(1);
}

/// Like forEachChunk(), for a device that works while the host continues. start(slot, begin, end) submits a range, or a
/// first part of it, and returns the end. wait(slot) waits for the range, and read(slot, begin, end) takes its results.
/// Up to kSlotCount ranges are in flight: the host reads one and prepares another while the device works. After an
/// exception, ranges may still be in flight.
template <size_t kSlotCount, typename Start, typename Wait, typename Read>
void forEachChunkInFlight(size_t count, ChunkSize size, const RunControl& control, const Start& start, const Wait& wait,
                          const Read& read) {
  struct Range {
    size_t begin, end;
    double startSeconds;
  };
  std::array<Range, kSlotCount> ranges;
  const Stopwatch stopwatch;
  double lastEndSeconds = 0;
  size_t startedCount = 0, begun = 0;
  for (size_t readCount = 0, done = 0; done < count; ++readCount) {
    control.checkpoint(static_cast<double>(done) / static_cast<double>(count));
    for (; begun < count && startedCount < readCount + kSlotCount; ++startedCount) {
      const size_t slot = startedCount % kSlotCount;
      ranges[slot] = {begun, 0, stopwatch.seconds()};
      begun = ranges[slot].end = start(slot, begun, std::min<size_t>(begun + size.current(), count));
    }
    const size_t slot = readCount % kSlotCount;
    const Range& range = ranges[slot];
    wait(slot);
    const double endSeconds = stopwatch.seconds();
    size.adapt(range.end - range.begin, endSeconds - std::max(range.startSeconds, lastEndSeconds));
    lastEndSeconds = endSeconds;
    read(slot, range.begin, range.end);
    done = range.end;
  }
  control.checkpoint(1);
}

}  // namespace asdfvk
