#include "seeds/dart_throwing.h"

#include <bit>
#include <limits>
#include <span>
#include <utility>

#include "core/check.h"

namespace asdfvk {
namespace {

// The order of positive floats is the order of their bits. Floats that differ only in the low bits of the mantissa form
// one level. Their common bits are the number of the level.
constexpr int kLevelShift = std::numeric_limits<float>::digits - 1 - std::countr_zero(kRadiiPerOctave);
constexpr uint32_t levelOf(float distance) { return std::bit_cast<uint32_t>(distance) >> kLevelShift; }
constexpr float lowestOf(uint32_t level) { return std::bit_cast<float>(level << kLevelShift); }
static_assert(std::has_single_bit(kRadiiPerOctave) && std::numeric_limits<float>::is_iec559);

constexpr size_t kTriesPerCheckpoint = 1024;
constexpr uint32_t kBottom = levelOf(kMinArcLength);

}  // namespace

ThrownDarts throwDarts(std::vector<uint32_t> waiting, uint64_t count, float startRadius, SurfaceDistances& distances,
                       const RunControl& stopOnly) {
  ASDFVK_CHECK_OP(count, <=, waiting.size());
  ASDFVK_CHECK_OP(startRadius, >=, kMinArcLength);
  const uint32_t top = levelOf(startRadius);
  std::vector<std::vector<uint32_t>> waitingAt(top - kBottom + 1);  // Waiting faces by level, beginning with kBottom.
  waitingAt.back() = std::move(waiting);
  ThrownDarts darts;
  darts.faces.reserve(static_cast<size_t>(count));
  for (uint32_t level = top; darts.faces.size() < count; --level) {
    const std::vector<uint32_t> tried = std::exchange(waitingAt[level - kBottom], {});
    const float radius = lowestOf(level);
    bool hasMore = false;  // True if more darts than `count` fit at this radius.
    for (size_t i = 0; i < tried.size() && !hasMore; ++i) {
      if (i % kTriesPerCheckpoint == 0) stopOnly.checkpoint(0);
      constexpr size_t kAhead = SurfaceDistances::kPrefetchDistance;
      if (i + kAhead < tried.size()) distances.prefetch(tried[i + kAhead]);
      if (i + kAhead / 2 < tried.size() && distances.at(tried[i + kAhead / 2]) >= radius)
        distances.prefetchArcs(tried[i + kAhead / 2]);
      const uint32_t face = tried[i];
      if (const float distance = distances.at(face); distance < radius) {
        waitingAt[levelOf(distance) - kBottom].push_back(face);
      } else if (darts.faces.size() == count) {
        hasMore = true;
      } else {
        distances.add({&face, 1}, radius);
        darts.faces.push_back(face);
      }
    }
    darts.leaveGaps = hasMore && level == top;
  }
  return darts;
}

}  // namespace asdfvk
