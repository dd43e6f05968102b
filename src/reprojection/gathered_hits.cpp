#include "reprojection/gathered_hits.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/lanes.h"
#include "mesh/buckets.h"

namespace asdfvk {
namespace {

constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

}  // namespace

bool isValidHit(const TraceScene& scene, const Cone& cone, uint32_t seedFace, const ConeHit& hit) {
  return hit.face != kNoFace && !isFalseHit(cone, scene.geometry.normals[seedFace], scene.geometry.normals[hit.face]);
}

std::vector<LengthWindow> keptLengths(const TraceScene& scene, const Cone& cone, const TracedCones& traced) {
  const size_t rayCount = cone.directions.size();
  std::vector<LengthWindow> windows(traced.seeds.size());
  forEachInParallel(windows.size(), [&](uint32_t i) {
    std::array<double, kMaxRayCount> lengths;
    size_t count = 0;
    for (const ConeHit& hit : traced.hits.subspan(i * rayCount, rayCount))
      if (isValidHit(scene, cone, traced.seeds[i], hit)) lengths[count++] = static_cast<double>(hit.distance);
    if (count > 0) windows[i] = keptWindow({lengths.data(), count}, cone.outlierDeviations);
  });
  return windows;
}

GatheredHits::GatheredHits(const TraceScene& scene, const Cone& cone, const TracedCones& traced,
                           std::span<const LengthWindow> windows)
    : scene_(scene),
      cone_(cone),
      traced_(traced),
      windows_(windows),
      raysPerCone_((cone.directions.size() + kLaneCount - 1) / kLaneCount * kLaneCount),
      raySolidAngle_(2 * std::numbers::pi * (1 - std::cos(cone.halfAngleRadians)) /
                     static_cast<double>(cone.directions.size())) {}

void GatheredHits::resize(size_t size) {
  for (std::vector<float>* coordinate : {&x, &y, &z}) coordinate->resize(size, kNowhere);
  for (std::vector<float>* number : {&nx, &ny, &nz, &spread, &kept}) number->resize(size, 0.0f);
  face.resize(size, kNoFace);
}

size_t GatheredHits::append(std::span<const Point> points) {
  const size_t coneCount = (points.size() + raysPerCone_ - 1) / raysPerCone_;
  size_t at = size();
  resize(at + coneCount * raysPerCone_);
  for (const Point& point : points) {
    x[at] = static_cast<float>(point.position.x);
    y[at] = static_cast<float>(point.position.y);
    z[at] = static_cast<float>(point.position.z);
    nx[at] = static_cast<float>(point.normal.x);
    ny[at] = static_cast<float>(point.normal.y);
    nz[at] = static_cast<float>(point.normal.z);
    spread[at] = static_cast<float>(point.area / raySolidAngle_);
    kept[at] = 1;
    face[at++] = point.face;
  }
  return coneCount;
}

void GatheredHits::gather(std::span<const uint32_t> cones) {
  resize(0);
  resize(cones.size() * raysPerCone_);
  const size_t rayCount = cone_.directions.size();
  for (size_t i = 0; i < cones.size(); ++i) {
    const uint32_t seedFace = traced_.seeds[cones[i]];
    const ConeFrame frame = faceConeFrame(cone_, scene_.geometry.normals[seedFace], seedFace);
    for (size_t ray = 0; ray < rayCount; ++ray) {
      const ConeHit& hit = traced_.hits[cones[i] * rayCount + ray];
      if (hit.face != kNoFace)
        put(i * raysPerCone_ + ray, hit, seedFace, frame, cone_.directions[ray], windows_[cones[i]]);
    }
  }
}

void GatheredHits::put(size_t at, const ConeHit& hit, uint32_t seedFace, const ConeFrame& frame, const Vec3d& local,
                       const LengthWindow& window) {
  const Vec3d direction = local.x * frame.tangent + local.y * frame.bitangent + local.z * frame.axis;
  const auto length = static_cast<double>(hit.distance);
  const Vec3d point = scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[seedFace]) + length * direction;
  const Vec3d& normal = scene_.geometry.normals[hit.face];
  x[at] = static_cast<float>(point.x);
  y[at] = static_cast<float>(point.y);
  z[at] = static_cast<float>(point.z);
  nx[at] = static_cast<float>(normal.x);
  ny[at] = static_cast<float>(normal.y);
  nz[at] = static_cast<float>(normal.z);
  spread[at] = hit.distance * hit.distance / (static_cast<float>(std::abs(dot(direction, normal))) + kGrazingSlack);
  kept[at] = isValidHit(scene_, cone_, seedFace, hit) && window.keeps(length) ? 1.0f : 0.0f;
  face[at] = hit.face;
}

}  // namespace asdfvk
