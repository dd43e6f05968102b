#pragma once

#include <array>

#include "trace/embree_scene.h"

namespace asdfvk {

/// The same ray of up to eight cones, side by side: where the cones are neighbours such rays walk the same nodes one
/// after the other, though Embree walks each by itself (RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT), so that what a ray
/// meets does not depend on the others. Lengths are in normalised units.
class EmbreeRays {
 public:
  static constexpr size_t kWidth = 8;

  /// Every ray ends at the nearest triangle that is not nearer than `start`. No lane has a cone yet.
  explicit EmbreeRays(double start);

  void setCone(size_t lane, const ConeFrame& frame, const Vec3d& origin);
  void removeCone(size_t lane) { isActive_[lane] = 0; }

  /// coneDirection: one of Cone::directions. Lanes without a cone keep what they had.
  void cast(const EmbreeScene& embree, const Vec3d& coneDirection);

  [[nodiscard]] float distance(size_t lane) const { return packet_.ray.tfar[lane]; }
  /// kNoFace for a miss.
  [[nodiscard]] uint32_t slot(size_t lane) const { return packet_.hit.primID[lane]; }

 private:
  alignas(32) std::array<int, kWidth> isActive_{};  // -1 or 0, as Embree takes it.
  // The frames of the cones: the x of all lanes, then the y, then the z.
  std::array<std::array<double, kWidth>, 3> tangents_{}, bitangents_{}, axes_{};
  RTCRayHit8 packet_;
};

}  // namespace asdfvk
