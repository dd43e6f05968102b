#include "seeds/dart_throwing.h"

#include <bit>
#include <limits>
#include <utility>

#include "core/check.h"
#include "seeds/surface_metric.h"

namespace asdfvk {
namespace {

// Positive floats order as their bits do. Those that agree but for the low bits of the mantissa are a rung of the
// ladder of radii, told by the bits that they share.
constexpr int kRungShift = std::numeric_limits<float>::digits - 1 - std::countr_zero(kRadiiPerOctave);
constexpr uint32_t rungOf(float distance) { return std::bit_cast<uint32_t>(distance) >> kRungShift; }
constexpr float lowestOf(uint32_t rung) { return std::bit_cast<float>(rung << kRungShift); }
static_assert(std::has_single_bit(kRadiiPerOctave) && std::numeric_limits<float>::is_iec559);

// Faces wait in random order; so many of them are under way from memory at once.
constexpr size_t kFetchedAhead = 16;

constexpr uint32_t kBottom = rungOf(kShortestArc);

}  // namespace

ThrownDarts throwDarts(std::vector<uint32_t> waiting, uint64_t count, float startRadius, SurfaceDistances& distances) {
  ASDFVK_CHECK_OP(count, <=, waiting.size());
  ASDFVK_CHECK_OP(startRadius, >=, kShortestArc);
  const uint32_t top = rungOf(startRadius);
  std::vector<std::vector<uint32_t>> waitingAt(top - kBottom + 1);
  waitingAt[top - kBottom] = std::move(waiting);
  ThrownDarts darts;
  darts.faces.reserve(static_cast<size_t>(count));
  for (uint32_t rung = top; darts.faces.size() < count; --rung) {
    const float radius = lowestOf(rung);
    const std::vector<uint32_t> tried = std::exchange(waitingAt[rung - kBottom], {});
    for (size_t i = 0; i < tried.size(); ++i) {
      if (i + kFetchedAhead < tried.size()) distances.fetch(tried[i + kFetchedAhead]);
      const uint32_t face = tried[i];
      const uint32_t reached = rungOf(distances.at(face));
      if (reached < rung) {
        waitingAt[reached - kBottom].push_back(face);
        continue;
      }
      if (darts.faces.size() == count) {
        darts.leaveGaps = rung == top;
        break;
      }
      distances.add({&face, 1}, radius);
      darts.faces.push_back(face);
    }
  }
  return darts;
}

}  // namespace asdfvk
