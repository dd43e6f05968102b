#include "predict/seed_points.h"

#include <algorithm>
#include <limits>

namespace asdfvk {
namespace {

constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

PointGroup emptyGroup() {
  PointGroup group{};
  for (float* coordinate : {group.x, group.y, group.z}) std::fill_n(coordinate, kPointGroupSize, kNowhere);
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

SeedPoints::SeedPoints(const TraceScene& scene, const Cone& cone, const TracedCones& traced)
    : scene_(scene), cone_(cone), traced_(traced) {}

void SeedPoints::clear() { groups_.clear(); }

PointCone SeedPoints::appendCone(size_t pointCount) {
  static const PointGroup empty = emptyGroup();
  const PointCone cone{static_cast<uint32_t>(groups_.size()),
                       static_cast<uint32_t>((pointCount + kPointGroupSize - 1) / kPointGroupSize)};
  groups_.resize(groups_.size() + cone.groupCount, empty);
  return cone;
}

PointCone SeedPoints::gather(uint32_t seed) {
  const std::span<const ConeHit> hits = traced_.hitsOf(seed);
  const uint32_t seedFace = traced_.seeds[seed];
  // They lie all over memory; waited for one by one they would take longer than all the rest.
  for (const ConeHit& hit : hits)
    if (hit.face != kNoFace) __builtin_prefetch(&scene_.geometry.normals[hit.face]);
  const LengthWindow window = keptLengths(scene_, cone_, traced_, seed);
  const ConeFrame frame = faceConeFrame(cone_, scene_.geometry.normals[seedFace], seedFace);
  const Vec3d origin = scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[seedFace]);
  PointCone cone = appendCone(hits.size());
  cone.medianLength = static_cast<float>(window.median);
  for (size_t ray = 0; ray < hits.size(); ++ray) {
    const ConeHit& hit = hits[ray];
    if (hit.face == kNoFace) continue;
    const Vec3d& local = cone_.directions[ray];
    const Vec3d direction = local.x * frame.tangent + local.y * frame.bitangent + local.z * frame.axis;
    const auto length = static_cast<double>(hit.distance);
    put(groups_[cone.firstGroup + ray / kPointGroupSize], ray % kPointGroupSize,
        {origin + length * direction, scene_.geometry.normals[hit.face], hit.distance * hit.distance,
         isValidHit(scene_, cone_, seedFace, hit) && window.keeps(length), hit.face});
  }
  return cone;
}

}  // namespace asdfvk
