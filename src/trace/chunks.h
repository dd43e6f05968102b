#pragma once

#include <algorithm>
#include <cstdint>

#include "asdf_vk/run_control.h"
#include "core/stopwatch.h"

namespace asdfvk {

/// Size of the next submission, adapted so that each takes about kTargetSeconds: short enough for progress and
/// cancellation, long enough to hide the cost of a submission.
class ChunkSize {
 public:
  static constexpr double kTargetSeconds = 0.07;
  static constexpr uint64_t kMin = 16;

  /// largest: at least 1.
  ChunkSize(uint64_t first, uint64_t largest) : size_(std::min(first, largest)), largest_(largest) {}

  [[nodiscard]] uint64_t current() const { return size_; }
  /// A chunk of `count` took `seconds`. The size changes at most fourfold, which bounds the effect of one outlier.
  void adapt(uint64_t count, double seconds) {
    const double ideal = static_cast<double>(count) * kTargetSeconds / std::max(seconds, 1e-6);
    const double bounded = std::clamp(ideal, static_cast<double>(size_) / 4, static_cast<double>(size_) * 4);
    size_ = std::clamp<uint64_t>(static_cast<uint64_t>(bounded), std::min(kMin, largest_), largest_);
  }

 private:
  uint64_t size_, largest_;
};

/// Calls work(begin, end) for consecutive ranges of [0, count), with a checkpoint before each and one at the end.
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

}  // namespace asdfvk
