#include "seeds/dart_throwing.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "seeds/dart_block.h"

namespace asdfvk {
namespace {

// Positive floats are ordered like their bits. The floats that differ only in the low bits of the mantissa form one
// level, numbered by the bits that they share.
constexpr int kLevelShift = std::numeric_limits<float>::digits - 1 - std::countr_zero(kRadiiPerOctave);
constexpr uint32_t levelOf(float distance) { return std::bit_cast<uint32_t>(distance) >> kLevelShift; }
constexpr float lowestOf(uint32_t level) { return std::bit_cast<float>(level << kLevelShift); }
static_assert(std::has_single_bit(kRadiiPerOctave) && std::numeric_limits<float>::is_iec559);

constexpr uint32_t kBottom = levelOf(kMinArcLength);

// A dart of a block takes 2.2 times the time of a dart that is thrown alone (docs/experiments.md).
constexpr size_t kMinThreadsForBlocks = 3;

/// Number of faces of the next block, by the blocks before it. It affects the time, not the darts.
class BlockSize {
 public:
  static constexpr size_t kMin = 256, kMax = 32768;

  /// dartCount: number of darts in all.
  explicit BlockSize(uint64_t dartCount) : maxOpenCount_(static_cast<double>(dartCount) / kDartsPerOpenFace) {}

  /// Too few darts leave too few disks that are searched at once.
  [[nodiscard]] bool isWorthwhile() const { return maxOpenCount_ >= kMinOpenCount; }
  [[nodiscard]] size_t next() const {
    return static_cast<size_t>(std::clamp<double>(scale_ * maxOpenCount_ / openShare_, kMin, kMax));
  }
  void adapt(const DartBlock& block, size_t faceCount) {
    const auto openCount = static_cast<double>(block.openCount());
    const double inVain = openCount - static_cast<double>(block.darts().size());
    openShare_ = std::max(1.0, openCount) / static_cast<double>(faceCount);
    if (inVain > kMaxShareInVain * openCount) scale_ = std::max(kMinScale, scale_ / 2);
    if (inVain < kMaxShareInVain / 2 * openCount) scale_ = std::min(1.0, scale_ * 2);
  }

 private:
  static constexpr double kDartsPerOpenFace = 32, kMinOpenCount = 16, kMaxShareInVain = 0.125, kMinScale = 1.0 / 64;

  double maxOpenCount_;
  double openShare_ = 1;
  double scale_ = 1;
};

class Throwing {
 public:
  Throwing(std::vector<uint32_t> waiting, uint64_t count, float startRadius, SurfaceDistances& distances)
      : distances_(distances),
        count_(count),
        top_(levelOf(startRadius)),
        waitingAt_(top_ - kBottom + 1),
        block_(distances),
        blockSize_(count) {
    waitingAt_.back() = std::move(waiting);
    darts_.faces.reserve(static_cast<size_t>(count));
    // At an infinite radius every disk is a whole component, and most of them are searched in vain.
    throwsBlocks_ = startRadius < SurfaceDistances::kUnreached && blockSize_.isWorthwhile() &&
                    maxThreadCount() >= kMinThreadsForBlocks;
  }

  [[nodiscard]] ThrownDarts run() {
    for (uint32_t level = top_; darts_.faces.size() < count_; --level) {
      const std::vector<uint32_t> tried = std::exchange(waitingAt_[level - kBottom], {});
      const bool hasMore =
          throwsBlocks_ && tried.size() >= BlockSize::kMin ? throwBlocks(tried, level) : throwEach(tried, level);
      darts_.leaveGaps = hasMore && level == top_;
    }
    return std::move(darts_);
  }

 private:
  void wait(uint32_t face, float distance) { waitingAt_[levelOf(distance) - kBottom].push_back(face); }

  // These two have the same result. They return whether more darts than `count` would fit.

  bool throwEach(std::span<const uint32_t> tried, uint32_t level) {
    const float radius = lowestOf(level);
    for (size_t i = 0; i < tried.size(); ++i) {
      if (i + SurfaceDistances::kPrefetchDistance < tried.size())
        distances_.prefetch(tried[i + SurfaceDistances::kPrefetchDistance]);
      if (const size_t soon = i + SurfaceDistances::kPrefetchDistance / 2;
          soon < tried.size() && distances_.at(tried[soon]) >= radius)
        distances_.prefetchArcs(tried[soon]);
      const uint32_t face = tried[i];
      if (const float distance = distances_.at(face); distance < radius) {
        wait(face, distance);
        continue;
      }
      if (darts_.faces.size() == count_) return true;
      distances_.add({&face, 1}, radius);
      darts_.faces.push_back(face);
    }
    return false;
  }

  bool throwBlocks(std::span<const uint32_t> tried, uint32_t level) {
    const float radius = lowestOf(level);
    while (!tried.empty()) {
      const std::span<const uint32_t> faces = tried.first(std::min(blockSize_.next(), tried.size()));
      tried = tried.subspan(faces.size());
      block_.throwAt(faces, radius, count_ - darts_.faces.size());
      for (uint32_t position : block_.darts()) darts_.faces.push_back(faces[position]);
      if (block_.isOverfull()) return true;
      for (size_t i = 0; i < faces.size(); ++i)
        if (const float distance = block_.distanceAt(i); distance < radius) wait(faces[i], distance);
      blockSize_.adapt(block_, faces.size());
    }
    return false;
  }

  SurfaceDistances& distances_;
  uint64_t count_;
  uint32_t top_;
  std::vector<std::vector<uint32_t>> waitingAt_;  ///< By level, from kBottom.
  DartBlock block_;
  BlockSize blockSize_;
  bool throwsBlocks_ = false;
  ThrownDarts darts_;
};

}  // namespace

ThrownDarts throwDarts(std::vector<uint32_t> waiting, uint64_t count, float startRadius, SurfaceDistances& distances) {
  ASDFVK_CHECK_OP(count, <=, waiting.size());
  ASDFVK_CHECK_OP(startRadius, >=, kMinArcLength);
  return Throwing(std::move(waiting), count, startRadius, distances).run();
}

}  // namespace asdfvk
