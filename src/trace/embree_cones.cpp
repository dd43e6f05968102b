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
      lengths_(kWidth * rayCount_),
      weights_(kWidth * rayCount_) {}

void EmbreeConeGroup::add(const EmbreeSeed& seed) {
  const size_t lane = size_++;
  seeds_[lane] = seed;
  normals_[lane] = cones_.scene.geometry.normals[seed.face];
  origins_[lane] = cones_.scene.bvh.normalization.toNormalized(cones_.scene.geometry.barycentres[seed.face]);
  isDoubtful_[lane] = false;
  validCounts_[lane] = 0;
  rays_.setCone(lane, faceConeFrame(cones_.cone, normals_[lane], seed.face), origins_[lane]);
}

void EmbreeConeGroup::clear() {
  for (size_t lane = 0; lane < size_; ++lane) rays_.removeCone(lane);
  size_ = 0;
}

void EmbreeConeGroup::trace() {
  for (size_t ray = 0; ray < rayCount_; ++ray) {
    rays_.cast(cones_.embree, cones_.cone.directions[ray]);
    for (size_t lane = 0; lane < size_; ++lane) take(ray, lane);
  }
}

void EmbreeConeGroup::take(size_t ray, size_t lane) {
  const uint32_t slot = rays_.slot(lane);
  const float distance = rays_.distance(lane);
  const EmbreeSeed& seed = seeds_[lane];
  const bool isRobust = cones_.embree.mode() == EmbreeMode::Robust;
  if (slot == kNoFace) {
    if (!seed.hits.empty()) seed.hits[ray] = kMiss;
    isDoubtful_[lane] |= !isRobust;
    return;
  }
  const SlotPlane& plane = cones_.planes[slot];
  const double cosine = dot(plane.normal, rays_.direction(lane));
  isDoubtful_[lane] |= slot == seed.slot || (!isRobust && !(cosine > 0));
  if (!seed.hits.empty()) seed.hits[ray] = {distance, cones_.scene.bvh.slotFaces[slot]};
  if (isFalseHit(cones_.cone, normals_[lane], plane.normal)) return;
  const size_t i = lane * rayCount_ + validCounts_[lane]++;
  lengths_[i] = lengthInDouble(origins_[lane], cosine, plane, distance);
  weights_[i] = cones_.cone.weights[ray];
}

double EmbreeConeGroup::value(size_t lane) const {
  const size_t first = lane * rayCount_, count = validCounts_[lane];
  return coneValue(std::span(lengths_).subspan(first, count), std::span(weights_).subspan(first, count),
                   cones_.cone.outlierDeviations);
}

}  // namespace asdfvk
