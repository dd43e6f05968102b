#include "seeds/dart_throwing.h"

#include <bit>
#include <utility>

#include "core/check.h"
#include "seeds/surface_metric.h"

namespace asdfvk {
namespace {

/// Positive floats in groups of consecutive ones, a rung each; the larger the higher.
class RadiusLadder {
 public:
  explicit RadiusLadder(uint32_t stepBits) : shift_(23 - stepBits) {}
  [[nodiscard]] uint32_t rungOf(float distance) const { return std::bit_cast<uint32_t>(distance) >> shift_; }
  [[nodiscard]] float radiusOf(uint32_t rung) const { return std::bit_cast<float>(rung << shift_); }

 private:
  uint32_t shift_;
};

}  // namespace

ThrownDarts throwDarts(std::vector<uint32_t> waiting, uint64_t count, const DartRadii& radii,
                       SurfaceDistances& distances) {
  ASDFVK_CHECK_OP(count, <=, waiting.size());
  ASDFVK_CHECK_OP(radii.stepBits, <=, 23u);
  ASDFVK_CHECK_OP(radii.start, >=, kShortestArc);
  const RadiusLadder ladder(radii.stepBits);
  const uint32_t top = ladder.rungOf(radii.start), bottom = ladder.rungOf(kShortestArc);
  std::vector<std::vector<uint32_t>> waitingAt(top - bottom + 1);
  waitingAt[top - bottom] = std::move(waiting);
  ThrownDarts darts;
  darts.faces.reserve(static_cast<size_t>(count));
  for (uint32_t rung = top; darts.faces.size() < count; --rung) {
    const float radius = ladder.radiusOf(rung);
    for (uint32_t face : std::exchange(waitingAt[rung - bottom], {})) {
      const uint32_t reached = ladder.rungOf(distances.at(face));
      if (reached < rung) {
        waitingAt[reached - bottom].push_back(face);
        continue;
      }
      if (darts.faces.size() == count) break;
      distances.add({&face, 1}, radius);
      darts.faces.push_back(face);
      darts.lastRadius = radius;
      darts.endedAtStart = rung == top;
    }
  }
  return darts;
}

}  // namespace asdfvk
