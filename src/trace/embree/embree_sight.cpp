#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "trace/embree/embree_cones.h"
#include "trace/sight_tracer.h"

namespace asdfvk {
namespace {

class EmbreeSightTracer final : public SightTracer {
 public:
  explicit EmbreeSightTracer(const TraceScene& scene)
      : unit_(scene.bvh.normalization), embree_(scene, EmbreeMode::Robust) {}

  void trace(std::span<const LineSegment> segments, std::span<uint8_t> isClear) const override {
    ASDFVK_CHECK_OP(segments.size(), ==, isClear.size());
    forEachInParallel(segments.size(), [&](uint32_t i) { isClear[i] = isBlocked(segments[i]) ? 0 : 1; });
  }

 private:
  [[nodiscard]] bool isBlocked(const LineSegment& segment) const {
    const Vec3d from = unit_.toNormalized(segment.from), between = unit_.toNormalized(segment.to) - from;
    if (!isFinite(from) || !isFinite(between) || between == Vec3d{}) return false;
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x);
    ray.org_y = static_cast<float>(from.y);
    ray.org_z = static_cast<float>(from.z);
    ray.dir_x = static_cast<float>(between.x);
    ray.dir_y = static_cast<float>(between.y);
    ray.dir_z = static_cast<float>(between.z);
    const double margin = std::max(kSightMargin, kContactDistance / length(between));
    if (margin >= 0.5) return false;
    ray.tnear = static_cast<float>(margin);
    ray.tfar = static_cast<float>(1 - margin);
    ray.mask = ~0u;
    return isOccluded(embree_.get(), ray);
  }

  Normalization unit_;
  EmbreeScene embree_;
};

}  // namespace

std::unique_ptr<SightTracer> makeEmbreeSightTracer(const TraceScene& scene) {
  return std::make_unique<EmbreeSightTracer>(scene);
}

}  // namespace asdfvk
