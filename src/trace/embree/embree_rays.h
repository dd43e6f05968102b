#pragma once

#include <array>

#include "trace/embree/embree_scene.h"
#include "trace/embree/lane_cones.h"

namespace asdfvk {

/// The same ray of up to eight cones, side by side: where the cones are neighbours such rays walk the same nodes one
/// after the other, though Embree walks each by itself (RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT), so that what a ray
/// meets does not depend on the others. Lengths are in normalised units.
class EmbreeRays {
 public:
  static constexpr size_t kWidth = LaneHits::kWidth;

  /// Every ray ends at the nearest triangle that is not nearer than `start`. No lane has an origin yet.
  explicit EmbreeRays(double start);

  void setOrigin(size_t lane, const Vec3d& origin);
  void remove(size_t lane) { isActive_[lane] = 0; }

  /// coneDirection: one of Cone::directions. Lanes without an origin meet nothing.
  [[nodiscard]] LaneHits cast(const EmbreeScene& embree, const LaneFrames& frames, const Vec3d& coneDirection);

 private:
  alignas(32) std::array<int, kWidth> isActive_{};  // -1 or 0, as Embree takes it.
  RTCRayHit8 packet_;
};

}  // namespace asdfvk
