#include "trace/embree_cones.h"

#include <cmath>

namespace asdfvk {
namespace {

/// Where the plane is not near what Embree says, its triangle is a sliver whose normal tells little.
double lengthInDouble(const Vec3d& origin, double cosine, const SlotPlane& plane, double distance) {
  constexpr double kPlaneTolerance = 0x1p-14;
  const double length = (plane.offset - dot(plane.normal, origin)) / cosine;
  return std::abs(length - distance) <= kPlaneTolerance ? length : distance;
}

}  // namespace

EmbreeConeGroup::EmbreeConeGroup(const EmbreeCones& cones)
    : cones_(cones),
      rayCount_(cones.cone.directions.size()),
      rays_(cones.rayStart),
      met_(rayCount_),
      lengths_(rayCount_),
      weights_(rayCount_) {}

void EmbreeConeGroup::add(const EmbreeSeed& seed) {
  Lane& lane = lanes_[size_];
  lane.seed = seed;
  lane.normal = cones_.scene.geometry.normals[seed.face];
  lane.origin = cones_.scene.bvh.normalization.toNormalized(cones_.scene.geometry.barycentres[seed.face]);
  lane.frame = faceConeFrame(cones_.cone, lane.normal, seed.face);
  rays_.setCone(size_++, lane.frame, lane.origin);
}

void EmbreeConeGroup::clear() {
  for (size_t lane = 0; lane < size_; ++lane) rays_.removeCone(lane);
  size_ = 0;
}

void EmbreeConeGroup::trace() {
  for (size_t ray = 0; ray < rayCount_; ++ray) {
    rays_.cast(cones_.embree, cones_.cone.directions[ray]);
    for (size_t lane = 0; lane < size_; ++lane) {
      met_[ray][lane] = {rays_.slot(lane), rays_.distance(lane)};
      if (rays_.slot(lane) != kNoFace) __builtin_prefetch(&cones_.planes[rays_.slot(lane)]);
    }
  }
  for (size_t lane = 0; lane < size_; ++lane) evaluate(lanes_[lane], lane);
}

void EmbreeConeGroup::evaluate(Lane& lane, size_t laneIndex) {
  const bool isRobust = cones_.embree.mode() == EmbreeMode::Robust;
  const std::span<ConeHit> hits = lane.seed.hits;
  bool isDoubtful = false;
  size_t validCount = 0;
  for (size_t ray = 0; ray < rayCount_; ++ray) {
    const auto [slot, distance] = met_[ray][laneIndex];
    if (slot == kNoFace) {
      if (!hits.empty()) hits[ray] = kMiss;
      isDoubtful |= !isRobust;
      continue;
    }
    const SlotPlane& plane = cones_.planes[slot];
    const Vec3d& d = cones_.cone.directions[ray];
    const double cosine =
        dot(plane.normal, d.x * lane.frame.tangent + d.y * lane.frame.bitangent + d.z * lane.frame.axis);
    isDoubtful |= slot == lane.seed.slot || (!isRobust && !(cosine > 0));
    if (!hits.empty()) hits[ray] = {distance, cones_.scene.bvh.slotFaces[slot]};
    if (isFalseHit(cones_.cone, lane.normal, plane.normal)) continue;
    lengths_[validCount] = lengthInDouble(lane.origin, cosine, plane, distance);
    weights_[validCount] = cones_.cone.weights[ray];
    ++validCount;
  }
  lane.isDoubtful = isDoubtful;
  lane.value = coneValue({lengths_.data(), validCount}, {weights_.data(), validCount}, cones_.cone.outlierDeviations);
}

}  // namespace asdfvk
