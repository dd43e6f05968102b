#include "trace/embree/embree_rays.h"

#include <algorithm>
#include <limits>

namespace asdfvk {

static_assert(RTC_INVALID_GEOMETRY_ID == kNoFace);

EmbreeRays::EmbreeRays(double start) : packet_{} {
  for (size_t lane = 0; lane < kWidth; ++lane) {
    packet_.ray.tnear[lane] = static_cast<float>(start);
    packet_.ray.mask[lane] = ~0u;
    packet_.hit.primID[lane] = kNoFace;
  }
}

void EmbreeRays::setOrigin(size_t lane, const Vec3d& origin) {
  isActive_[lane] = -1;
  packet_.ray.org_x[lane] = static_cast<float>(origin.x);
  packet_.ray.org_y[lane] = static_cast<float>(origin.y);
  packet_.ray.org_z[lane] = static_cast<float>(origin.z);
}

LaneHits EmbreeRays::cast(const EmbreeScene& embree, const LaneFrames& frames, const Vec3d& coneDirection) {
  float* const rows[] = {packet_.ray.dir_x, packet_.ray.dir_y, packet_.ray.dir_z};
  const Vec3d& d = coneDirection;
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t lane = 0; lane < kWidth; ++lane)
      rows[axis][lane] = static_cast<float>(d.x * frames.tangents[axis][lane] + d.y * frames.bitangents[axis][lane] +
                                            d.z * frames.axes[axis][lane]);
  for (size_t lane = 0; lane < kWidth; ++lane) {
    packet_.ray.tfar[lane] = std::numeric_limits<float>::infinity();
    packet_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    packet_.hit.primID[lane] = kNoFace;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect8(isActive_.data(), embree.get(), &context, &packet_);
  LaneHits hits;
  std::copy_n(packet_.hit.primID, kWidth, hits.slots.begin());
  std::copy_n(packet_.ray.tfar, kWidth, hits.distances.begin());
  return hits;
}

}  // namespace asdfvk
