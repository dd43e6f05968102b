#pragma once

#include <vector>

#include "trace/embree_scene.h"

namespace asdfvk {

/// The rays of one cone and what each of them met, eight to a packet: Embree walks them one by one all the same
/// (RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT), but is called less often. Lengths are in normalised units.
class EmbreeRays {
 public:
  explicit EmbreeRays(size_t rayCount);

  /// Every ray ends at the nearest triangle that is not nearer than `start`.
  void cast(const EmbreeScene& embree, const Cone& cone, const ConeFrame& frame, const Vec3d& origin, double start);

  [[nodiscard]] const Vec3d& direction(size_t ray) const { return directions_[ray]; }
  [[nodiscard]] float distance(size_t ray) const { return packets_[ray / kWidth].ray.tfar[ray % kWidth]; }
  /// kNoFace for a miss.
  [[nodiscard]] uint32_t slot(size_t ray) const { return packets_[ray / kWidth].hit.primID[ray % kWidth]; }
  [[nodiscard]] bool hasMet(uint32_t slot) const;

 private:
  static constexpr size_t kWidth = 8;

  std::vector<Vec3d> directions_;
  std::vector<RTCRayHit8> packets_;
};

}  // namespace asdfvk
