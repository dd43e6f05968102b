#include "trace/embree_rays.h"

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

void EmbreeRays::setCone(size_t lane, const ConeFrame& frame, const Vec3d& origin) {
  isActive_[lane] = -1;
  for (size_t axis = 0; axis < 3; ++axis) {
    tangents_[axis][lane] = frame.tangent[axis];
    bitangents_[axis][lane] = frame.bitangent[axis];
    axes_[axis][lane] = frame.axis[axis];
  }
  packet_.ray.org_x[lane] = static_cast<float>(origin.x);
  packet_.ray.org_y[lane] = static_cast<float>(origin.y);
  packet_.ray.org_z[lane] = static_cast<float>(origin.z);
}

void EmbreeRays::cast(const EmbreeScene& embree, const Vec3d& coneDirection) {
  float* const rows[] = {packet_.ray.dir_x, packet_.ray.dir_y, packet_.ray.dir_z};
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t lane = 0; lane < kWidth; ++lane) {
      const double d = coneDirection.x * tangents_[axis][lane] + coneDirection.y * bitangents_[axis][lane] +
                       coneDirection.z * axes_[axis][lane];
      rows[axis][lane] = static_cast<float>(d);
    }
  for (size_t lane = 0; lane < kWidth; ++lane) {
    packet_.ray.tfar[lane] = std::numeric_limits<float>::infinity();
    packet_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    packet_.hit.primID[lane] = kNoFace;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect8(isActive_.data(), embree.get(), &context, &packet_);
}

}  // namespace asdfvk
