#include "trace/cpu/cone_group.h"

#include <limits>

#include "core/check.h"
#include "core/prefetch.h"

namespace asdfvk {

ConeGroup::ConeGroup(const CpuCones& cones)
    : cones_(cones),
      walk_(cones.bvh, &cones.scene),
      lanes_(cones.cone, cones.scene),
      hits_(cones.cone.directions.size()) {
  const auto contactDistance = static_cast<float>(cones.cone.contactDistance);
  rays_.begins.fill(contactDistance);
  rays_.outerSideAddition = kOuterSideFactor * contactDistance;
  rays_.ends.fill(std::numeric_limits<float>::max());
}

void ConeGroup::add(const CpuSeed& seed) {
  ASDFVK_CHECK(size_ == 0 || seed.hits.empty() == seeds_[0].hits.empty());
  const size_t lane = size_++;
  seeds_[lane] = seed;
  frames_.set(lane, seed.start.frame, seed.start.origin, seed.start.normal);
  rays_.skipped[lane] = seed.primitive;
  for (size_t axis = 0; axis < 3; ++axis) rays_.origins[axis][lane] = static_cast<float>(seed.start.origin[axis]);
  if (seed.fitsFloat) rays_.active |= 1U << lane;
}

void ConeGroup::clear() {
  rays_.active = 0;
  size_ = 0;
}

void ConeGroup::trace() {
  // setFaces() reads scattered entries of primitiveFaces. These entries are prefetched after each ray, and arrive while
  // the next ray is traced. Only then is setFaces() called.
  RayGroup::Indices primitives;
  for (size_t ray = 0; ray < hits_.size(); ++ray) {
    cast(cones_.cone.directions[ray]);
    for (const uint32_t primitive : rays_.primitives)
      if (primitive != kNoFace) prefetchMemory(&cones_.scene.bvh.primitiveFaces[primitive]);
    if (ray > 0) setFaces(primitives, hits_[ray - 1]);
    primitives = rays_.primitives;
    hits_[ray].distances = rays_.distances;
  }
  setFaces(primitives, hits_.back());
  lanes_.measure(frames_, hits_);
  values_ = lanes_.values();
  if (size_ > 0 && !seeds_[0].hits.empty())
    for (size_t lane = 0; lane < size_; ++lane) writeHits(lane);
}

/// coneDirection: one of Cone::directions.
void ConeGroup::cast(const Vec3d& coneDirection) {
  const Vec3d& d = coneDirection;
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t lane = 0; lane < kWidth; ++lane)
      rays_.directions[axis][lane] = static_cast<float>(
          d.x * frames_.tangents[axis][lane] + d.y * frames_.bitangents[axis][lane] + d.z * frames_.axes[axis][lane]);
  walk_.findNearest(rays_);
}

/// Sets the faces of the hits of one ray per cone, and prefetches what LaneCones::measure() reads of them.
void ConeGroup::setFaces(const RayGroup::Indices& primitives, LaneHits& hits) const {
  for (size_t lane = 0; lane < kWidth; ++lane) {
    const uint32_t primitive = primitives[lane];
    hits.faces[lane] = kNoFace;
    if (primitive == kNoFace) continue;
    const uint32_t face = hits.faces[lane] = cones_.scene.bvh.primitiveFaces[primitive];
    prefetchMemory(&cones_.scene.geometry.normals[face]);
    prefetchMemory(&cones_.scene.geometry.barycentres[face]);
  }
}

void ConeGroup::writeHits(size_t lane) const {
  for (size_t ray = 0; ray < hits_.size(); ++ray) {
    const uint32_t face = hits_[ray].faces[lane];
    seeds_[lane].hits[ray] = face == kNoFace ? kMiss : ConeHit{hits_[ray].distances[lane], face};
  }
}

}  // namespace asdfvk
