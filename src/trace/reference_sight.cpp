#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "trace/nearest_hit.h"
#include "trace/sight_tracer.h"

namespace asdfvk {
namespace {

class ReferenceSightTracer final : public SightTracer {
 public:
  explicit ReferenceSightTracer(const TraceScene& scene) : scene_(scene) {}

  void trace(std::span<const LineSegment> segments, std::span<uint8_t> isClear) const override {
    ASDFVK_CHECK_OP(segments.size(), ==, isClear.size());
    forEachInParallel(segments.size(), [&](uint32_t i) { isClear[i] = isBlocked(segments[i]) ? 0 : 1; });
  }

 private:
  [[nodiscard]] bool isBlocked(const LineSegment& segment) const {
    const Normalization& unit = scene_.bvh.normalization;
    const Vec3d from = unit.toNormalized(segment.from), between = unit.toNormalized(segment.to) - from;
    const double distance = length(between);
    if (!(distance > 0) || !std::isfinite(distance)) return false;
    const double margin = std::max(kSightMargin * distance, kContactDistance);
    return isHitBetween(scene_.bvh, scene_.mesh, from, between / distance, margin, distance - margin);
  }

  TraceScene scene_;
};

}  // namespace

std::unique_ptr<SightTracer> makeReferenceSightTracer(const TraceScene& scene) {
  return std::make_unique<ReferenceSightTracer>(scene);
}

}  // namespace asdfvk
