#pragma once

#include <algorithm>
#include <cstdint>

namespace asdfvk {

/// How much work to submit at once so that a chunk takes about kTargetSeconds: short enough to show progress and to
/// cancel, long enough to hide what a submission costs.
class ChunkSize {
 public:
  static constexpr double kTargetSeconds = 0.07;
  static constexpr uint64_t kSmallest = 16;

  /// largest: at least 1.
  ChunkSize(uint64_t first, uint64_t largest) : size_(std::min(first, largest)), largest_(largest) {}

  [[nodiscard]] uint64_t current() const { return size_; }
  /// A chunk of `count` took `seconds`. Grows at most fourfold, so that one odd measurement does not run away.
  void adapt(uint64_t count, double seconds) {
    const double ideal = static_cast<double>(count) * kTargetSeconds / std::max(seconds, 1e-6);
    const double bounded = std::clamp(ideal, static_cast<double>(size_) / 4, static_cast<double>(size_) * 4);
    size_ = std::clamp<uint64_t>(static_cast<uint64_t>(bounded), std::min(kSmallest, largest_), largest_);
  }

 private:
  uint64_t size_, largest_;
};

}  // namespace asdfvk
