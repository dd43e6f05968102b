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
  for (const ConeHit& hit : hits_.of(seed))
    if (hit.face != kNoFace) prefetchMemory(&scene_.geometry.normals[hit.face]);
}

/// Whether a hit is neither a miss nor a false hit.
bool HitPoints::isValid(uint32_t seedFace, const Vec3d& direction, const ConeHit& hit) const {
  return hit.face != kNoFace &&
         !isFalseHit(cone_, scene_.geometry.normals[seedFace], direction, scene_.geometry.normals[hit.face]);
}

/// The window of the lengths that the outlier rule keeps in the cone of the seed. In normalised units.
LengthWindow HitPoints::inlierWindow(uint32_t seed, const ConeFrame& frame) const {
  const std::span<const ConeHit> hits = hits_.of(seed);
  std::array<double, kMaxRayCount> lengths;
  size_t count = 0;
  for (size_t ray = 0; ray < hits.size(); ++ray)
    if (isValid(hits_.seeds[seed], frame.toWorld(cone_.directions[ray]), hits[ray]))
      lengths[count++] = static_cast<double>(hits[ray].distance);
  return count > 0 ? keptWindow({lengths.data(), count}, cone_.outliers) : LengthWindow{};
}

HitRange HitPoints::appendEmpty(size_t pointCount) {
  static const PointGroup empty = emptyGroup();
  const HitRange range{static_cast<uint32_t>(groups_.size()),
                       static_cast<uint32_t>((pointCount + kPointGroupSize - 1) / kPointGroupSize)};
  groups_.resize(groups_.size() + range.groupCount, empty);
  return range;
}

HitRange HitPoints::append(uint32_t seed) {
  const std::span<const ConeHit> hits = hits_.of(seed);
  const uint32_t seedFace = hits_.seeds[seed];
  const ConeFrame frame = seedConeFrame(scene_, cone_, seedFace);
  const LengthWindow window = inlierWindow(seed, frame);
  const Vec3d origin = scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[seedFace]);
  HitRange range = appendEmpty(hits.size());
  range.medianLength = static_cast<float>(window.median);
  for (size_t ray = 0; ray < hits.size(); ++ray) {
    const ConeHit& hit = hits[ray];
    if (hit.face == kNoFace) continue;
    const Vec3d direction = frame.toWorld(cone_.directions[ray]);
    const auto length = static_cast<double>(hit.distance);
    put(groups_[range.firstGroup + ray / kPointGroupSize], ray % kPointGroupSize,
        {origin + length * direction, scene_.geometry.normals[hit.face],
         hit.distance * hit.distance * static_cast<float>(cone_.solidAngles[ray]),
         isValid(seedFace, direction, hit) && window.keeps(length), hit.face});
  }
  return range;
}

}  // namespace asdfvk
