#include "predict/hit_points.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/prefetch.h"

namespace asdfvk {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

PointGroup emptyGroup() {
  PointGroup group{};
  for (float* coordinate : {group.x, group.y, group.z}) std::fill_n(coordinate, kPointGroupSize, kNaN);
  std::fill_n(group.face, kPointGroupSize, kNoFace);
  return group;
}

struct GroupPoint {
  const Vec3d& position;
  const Vec3d& normal;
  float solidAngleRatio;
  bool isInlier;
  uint32_t face;
};

void put(PointGroup& group, size_t lane, const GroupPoint& point) {
  group.x[lane] = static_cast<float>(point.position.x);
  group.y[lane] = static_cast<float>(point.position.y);
  group.z[lane] = static_cast<float>(point.position.z);
  group.nx[lane] = static_cast<float>(point.normal.x);
  group.ny[lane] = static_cast<float>(point.normal.y);
  group.nz[lane] = static_cast<float>(point.normal.z);
  group.solidAngleRatio[lane] = point.solidAngleRatio;
  group.isInlier[lane] = point.isInlier ? 1.0f : 0.0f;
  group.face[lane] = point.face;
}

}  // namespace

HitPoints::HitPoints(const TraceScene& scene, const Cone& cone, const SeedHitsView& hits)
    : scene_(scene), cone_(cone), hits_(hits) {}

void HitPoints::clear() { groups_.clear(); }

void HitPoints::prefetchHits(uint32_t seed) const {
  const auto hits = std::as_bytes(hits_.of(seed));
  for (size_t place = 0; place < hits.size(); place += 64) prefetchMemory(&hits[place]);
  prefetchMemory(&hits.back());  // The hits may begin within a cache line.
  prefetchMemory(&scene_.geometry.barycentres[hits_.seeds[seed]]);
  prefetchMemory(&scene_.geometry.normals[hits_.seeds[seed]]);
}

void HitPoints::prefetchNormals(uint32_t seed) const {
  for (const ConeHit& hit : hits_.of(seed)) prefetchNormal(hit);
}

void HitPoints::prefetchNormal(const ConeHit& hit) const {
  if (hit.face != kNoFace) prefetchMemory(&scene_.geometry.normals[hit.face]);
}

HitRange HitPoints::appendEmpty(size_t pointCount) {
  static const PointGroup empty = emptyGroup();
  const HitRange range{static_cast<uint32_t>(groups_.size()),
                       static_cast<uint32_t>((pointCount + kPointGroupSize - 1) / kPointGroupSize)};
  groups_.resize(groups_.size() + range.groupCount, empty);
  return range;
}

// One prefetch per ray, because prefetches that immediately follow each other wait for free line fill buffers.
HitRange HitPoints::append(uint32_t seed, uint32_t later) {
  const std::span<const ConeHit> hits = hits_.of(seed), laterHits = hits_.of(later);
  const uint32_t seedFace = hits_.seeds[seed];
  const Vec3d& seedNormal = scene_.geometry.normals[seedFace];
  const ConeFrame frame = seedConeFrame(scene_, cone_, seedFace);
  const Vec3d origin = scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[seedFace]);
  HitRange range = appendEmpty(hits.size());
  PointGroup* const groups = &groups_[range.firstGroup];
  std::array<double, kMaxRayCount> lengths;  // Lengths of hits that are not false.
  size_t validCount = 0;
  for (size_t ray = 0; ray < hits.size(); ++ray) {
    prefetchNormal(laterHits[ray]);
    const ConeHit& hit = hits[ray];
    if (hit.face == kNoFace) continue;
    const Vec3d direction = frame.toWorld(cone_.directions[ray]);
    const Vec3d& normal = scene_.geometry.normals[hit.face];
    const auto length = static_cast<double>(hit.distance);
    const bool isValid = !isFalseHit(cone_, seedNormal, direction, normal);
    put(groups[ray / kPointGroupSize], ray % kPointGroupSize,
        {origin + length * direction, normal, hit.distance * hit.distance * static_cast<float>(cone_.solidAngles[ray]),
         isValid, hit.face});
    lengths[validCount] = length;
    validCount += isValid ? 1 : 0;
  }
  if (validCount == 0) return range;
  const LengthWindow window = keptWindow({lengths.data(), validCount}, cone_.outliers);
  range.medianLength = static_cast<float>(window.median);
  for (size_t ray = 0; ray < hits.size(); ++ray)
    if (!window.keeps(static_cast<double>(hits[ray].distance)))
      groups[ray / kPointGroupSize].isInlier[ray % kPointGroupSize] = 0;
  return range;
}

}  // namespace asdfvk
