#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "trace/cpu/ray_walk.h"
#include "trace/sight_tracer.h"

namespace asdfvk {
namespace {

class CpuSightTracer final : public SightTracer {
 public:
  explicit CpuSightTracer(const TraceScene& scene)
      : unit_(scene.bvh.normalization),
        bvh_(encodeLaneBvh(scene.bvh, scene.mesh)),
        reference_(makeReferenceSightTracer(scene)) {}

  void trace(std::span<const LineSegment> segments, std::span<uint8_t> isClear) const override {
    ASDFVK_CHECK_OP(segments.size(), ==, isClear.size());
    PerThread<RayWalk> walks([&] { return RayWalk(bvh_); });
    constexpr size_t kWidth = RayGroup::kWidth;
    forEachRange((segments.size() + kWidth - 1) / kWidth, 1, [&](size_t firstGroup, size_t endGroup) {
      RayWalk& walk = walks.local();
      for (size_t group = firstGroup; group < endGroup; ++group) {
        const size_t begin = group * kWidth, count = std::min(kWidth, segments.size() - begin);
        traceGroup(walk, segments.subspan(begin, count), isClear.subspan(begin, count));
      }
    });
  }

 private:
  void traceGroup(RayWalk& walk, std::span<const LineSegment> segments, std::span<uint8_t> isClear) const {
    RayGroup rays;
    rays.skipped.fill(kNoFace);
    std::fill(isClear.begin(), isClear.end(), uint8_t{1});
    for (size_t i = 0; i < segments.size(); ++i) {
      const Vec3d from = unit_.toNormalized(segments[i].from), between = unit_.toNormalized(segments[i].to) - from;
      if (!isFinite(from) || !isFinite(between) || between == Vec3d{}) continue;
      const double margin = std::max(kSightMargin, kContactDistance / length(between));
      if (margin >= 0.5) continue;
      if (!isNearBox(from) || !isNearBox(from + between)) {
        reference_->trace(segments.subspan(i, 1), isClear.subspan(i, 1));
        continue;
      }
      rays.active |= 1U << i;
      rays.begins[i] = static_cast<float>(margin);
      rays.ends[i] = static_cast<float>(1 - margin);
      for (size_t axis = 0; axis < 3; ++axis) {
        rays.origins[axis][i] = static_cast<float>(from[axis]);
        rays.directions[axis][i] = static_cast<float>(between[axis]);
      }
    }
    walk.findAny(rays);
    for (size_t i = 0; i < segments.size(); ++i)
      if (rays.primitives[i] != kNoFace) isClear[i] = 0;
  }

  Normalization unit_;
  LaneBvh bvh_;
  std::unique_ptr<SightTracer> reference_;  // For segments that begin or end outside of the box.
};

}  // namespace

std::unique_ptr<SightTracer> makeCpuSightTracer(const TraceScene& scene) {
  return std::make_unique<CpuSightTracer>(scene);
}

}  // namespace asdfvk
