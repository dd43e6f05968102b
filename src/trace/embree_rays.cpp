#include "trace/embree_rays.h"

#include <array>
#include <limits>

namespace asdfvk {

static_assert(RTC_INVALID_GEOMETRY_ID == kNoFace);

EmbreeRays::EmbreeRays(size_t rayCount) : directions_(rayCount), packets_((rayCount + kWidth - 1) / kWidth) {}

void EmbreeRays::cast(const EmbreeScene& embree, const Cone& cone, const ConeFrame& frame, const Vec3d& origin,
                      double start) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  const Vec3f floatOrigin(origin);
  for (size_t first = 0; first < directions_.size(); first += kWidth) {
    RTCRayHit8& packet = packets_[first / kWidth];
    alignas(32) std::array<int, kWidth> isActive;
    for (size_t lane = 0; lane < kWidth; ++lane) {
      const size_t i = first + lane;
      isActive[lane] = i < directions_.size() ? -1 : 0;
      if (!isActive[lane]) continue;
      const Vec3d& d = cone.directions[i];
      directions_[i] = d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.axis;
      packet.ray.org_x[lane] = floatOrigin.x;
      packet.ray.org_y[lane] = floatOrigin.y;
      packet.ray.org_z[lane] = floatOrigin.z;
      packet.ray.tnear[lane] = static_cast<float>(start);
      packet.ray.dir_x[lane] = static_cast<float>(directions_[i].x);
      packet.ray.dir_y[lane] = static_cast<float>(directions_[i].y);
      packet.ray.dir_z[lane] = static_cast<float>(directions_[i].z);
      packet.ray.time[lane] = 0;
      packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
      packet.ray.mask[lane] = ~0u;
      packet.ray.id[lane] = 0;
      packet.ray.flags[lane] = 0;
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.primID[lane] = kNoFace;
    }
    rtcIntersect8(isActive.data(), embree.get(), &context, &packet);
  }
}

bool EmbreeRays::hasMet(uint32_t slot) const {
  for (size_t ray = 0; ray < directions_.size(); ++ray)
    if (this->slot(ray) == slot) return true;
  return false;
}

}  // namespace asdfvk
