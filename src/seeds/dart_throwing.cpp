#include "seeds/dart_throwing.h"

#include <bit>
#include <limits>
#include <utility>

#include "core/check.h"

namespace asdfvk {
namespace {

// Positive floats are ordered like their bits. The floats that differ only in the low bits of the mantissa form one
// level, numbered by the bits that they share.
constexpr int kLevelShift = std::numeric_limits<float>::digits - 1 - std::countr_zero(kRadiiPerOctave);
constexpr uint32_t levelOf(float distance) { return std::bit_cast<uint32_t>(distance) >> kLevelShift; }
constexpr float lowestOf(uint32_t level) { return std::bit_cast<float>(level << kLevelShift); }
static_assert(std::has_single_bit(kRadiiPerOctave) && std::numeric_limits<float>::is_iec559);

// Waiting faces are in random order in memory; this many are prefetched.
constexpr size_t kPrefetchDistance = 16;

constexpr uint32_t kBottom = levelOf(kMinArcLength);

}  // namespace

ThrownDarts throwDarts(std::vector<uint32_t> waiting, uint64_t count, float startRadius, SurfaceDistances& distances) {
  ASDFVK_CHECK_OP(count, <=, waiting.size());
  ASDFVK_CHECK_OP(startRadius, >=, kMinArcLength);
  const uint32_t top = levelOf(startRadius);
  std::vector<std::vector<uint32_t>> waitingAt(top - kBottom + 1);
  waitingAt[top - kBottom] = std::move(waiting);
  ThrownDarts darts;
  darts.faces.reserve(static_cast<size_t>(count));
  for (uint32_t level = top; darts.faces.size() < count; --level) {
    const float radius = lowestOf(level);
    const std::vector<uint32_t> tried = std::exchange(waitingAt[level - kBottom], {});
    for (size_t i = 0; i < tried.size(); ++i) {
      if (i + kPrefetchDistance < tried.size()) distances.prefetch(tried[i + kPrefetchDistance]);
      const uint32_t face = tried[i];
      const uint32_t reached = levelOf(distances.at(face));
      if (reached < level) {
        waitingAt[reached - kBottom].push_back(face);
        continue;
      }
      if (darts.faces.size() == count) {
        darts.leaveGaps = level == top;
        break;
      }
      distances.add({&face, 1}, radius);
      darts.faces.push_back(face);
    }
  }
  return darts;
}

}  // namespace asdfvk
