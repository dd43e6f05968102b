#include "trace/embree/embree_cones.h"

#include "trace/float_limits.h"

namespace asdfvk {

EmbreeConeGroup::EmbreeConeGroup(const EmbreeCones& cones)
    : cones_(cones), rays_(cones.rayStart), lanes_(cones.cone, cones.planes), met_(cones.cone.directions.size()) {}

void EmbreeConeGroup::add(const EmbreeSeed& seed) {
  const size_t lane = size_++;
  const Vec3d& normal = cones_.scene.geometry.normals[seed.face];
  const Vec3d origin = cones_.scene.bvh.normalization.toNormalized(cones_.scene.geometry.barycentres[seed.face]);
  seeds_[lane] = seed;
  points_[lane] = {origin, seed.slot};
  frames_.set(lane, faceConeFrame(cones_.cone, normal, seed.face), origin, normal);
  rays_.setOrigin(lane, origin);
}

void EmbreeConeGroup::clear() {
  for (size_t lane = 0; lane < size_; ++lane) rays_.remove(lane);
  size_ = 0;
}

void EmbreeConeGroup::trace() {
  findUnfit();
  for (size_t ray = 0; ray < met_.size(); ++ray) {
    met_[ray] = rays_.cast(cones_.embree, frames_, cones_.cone.directions[ray]);
    for (const uint32_t slot : met_[ray].slots)
      if (slot != kNoFace) __builtin_prefetch(&cones_.planes[slot]);
  }
  lanes_.measure(frames_, met_);
  values_ = lanes_.values();
  for (size_t lane = 0; lane < size_; ++lane) {
    isDoubtful_[lane] =
        isUnfit_[lane] || leavesSurface(lane) || values_[lane] < kShortestFloatDiameter || metItself(lane);
    if (!seeds_[lane].hits.empty()) writeHits(lane);
  }
}

/// Takes cones out that are too small for float32, or that have another face as near as rays begin.
void EmbreeConeGroup::findUnfit() {
  const std::array<bool, kWidth> hasNeighbour =
      haveNeighboursWithin(cones_.scene, cones_.planes, {points_.data(), size_}, cones_.rayStart);
  for (size_t lane = 0; lane < size_; ++lane) {
    isUnfit_[lane] = hasNeighbour[lane] || isTooSmallForFloat(cones_.scene, seeds_[lane].face);
    if (isUnfit_[lane]) rays_.remove(lane);
  }
}

bool EmbreeConeGroup::leavesSurface(size_t lane) const {
  return !isUnfit_[lane] && cones_.embree.mode() != EmbreeMode::Robust && lanes_.leavesSurface(lane);
}

bool EmbreeConeGroup::metItself(size_t lane) const {
  bool result = false;
  for (const LaneHits& hits : met_) result |= hits.slots[lane] == seeds_[lane].slot;
  return result;
}

void EmbreeConeGroup::writeHits(size_t lane) const {
  for (size_t ray = 0; ray < met_.size(); ++ray) {
    const uint32_t slot = met_[ray].slots[lane];
    seeds_[lane].hits[ray] =
        slot == kNoFace ? kMiss : ConeHit{met_[ray].distances[lane], cones_.scene.bvh.slotFaces[slot]};
  }
}

}  // namespace asdfvk
