#include "trace/embree/embree_cones.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <new>

#include "asdf_vk/error.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

/// Throws the pending error of the device, if any; null: the error of a failed creation.
void throwEmbreeError(RTCDevice device) {
  switch (const RTCError error = rtcGetDeviceError(device)) {
    case RTC_ERROR_NONE:
      return;
    case RTC_ERROR_OUT_OF_MEMORY:
      throw std::bad_alloc();
    default:
      throw Error(ErrorCode::EmbreeFailed, fmt::format("Embree failed with error {}", static_cast<int>(error)));
  }
}

struct FloatPoint {
  float x, y, z;
};

void copyTriangles(const TraceScene& scene, RTCGeometry geometry) {
  const std::span<const Vec3d> vertices = scene.mesh.vertices;
  const std::vector<uint32_t>& primitiveFaces = scene.bvh.primitiveFaces;
  auto* points = static_cast<FloatPoint*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(FloatPoint), vertices.size()));
  auto* triangles = static_cast<Face*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                               sizeof(Face), primitiveFaces.size()));
  if (points == nullptr || triangles == nullptr) return;  // The error stays pending in the device.
  forEachInParallel(vertices.size(), [&](size_t i) {
    const Vec3d p = scene.bvh.normalization.toNormalized(vertices[i]);
    points[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  });
  forEachInParallel(primitiveFaces.size(), [&](size_t i) { triangles[i] = scene.mesh.faces[primitiveFaces[i]]; });
}

}  // namespace

static_assert(RTC_INVALID_GEOMETRY_ID == kNoFace);

EmbreeScene::EmbreeScene(const TraceScene& scene, EmbreeMode mode) : mode_(mode), device_(rtcNewDevice(nullptr)) {
  if (!device_) throwEmbreeError(nullptr);
  scene_.reset(rtcNewScene(device_.get()));
  if (mode == EmbreeMode::Robust) rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  copyTriangles(scene, geometry);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_.get(), geometry, 0);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
  throwEmbreeError(device_.get());
}

EmbreeConeGroup::EmbreeConeGroup(const EmbreeCones& cones)
    : cones_(cones), lanes_(cones.cone, cones.planes), hits_(cones.cone.directions.size()) {
  for (size_t lane = 0; lane < kWidth; ++lane) {
    packet_.ray.tnear[lane] = static_cast<float>(cones.cone.contactDistance);
    packet_.ray.mask[lane] = ~0u;
    packet_.hit.primID[lane] = kNoFace;
  }
}

void EmbreeConeGroup::add(const EmbreeSeed& seed) {
  const size_t lane = size_++;
  const Vec3d& origin = seed.start.origin;
  seeds_[lane] = seed;
  frames_.set(lane, seed.start.frame, origin, seed.start.normal);
  isActive_[lane] = seed.fitsFloat ? -1 : 0;
  packet_.ray.org_x[lane] = static_cast<float>(origin.x);
  packet_.ray.org_y[lane] = static_cast<float>(origin.y);
  packet_.ray.org_z[lane] = static_cast<float>(origin.z);
}

void EmbreeConeGroup::clear() {
  isActive_.fill(0);
  size_ = 0;
}

void EmbreeConeGroup::trace() {
  for (size_t ray = 0; ray < hits_.size(); ++ray) {
    hits_[ray] = cast(cones_.cone.directions[ray]);
    for (const uint32_t primitive : hits_[ray].primitives)
      if (primitive != kNoFace) __builtin_prefetch(&cones_.planes[primitive]);
  }
  lanes_.measure(frames_, hits_);
  values_ = lanes_.values();
  for (size_t lane = 0; lane < size_; ++lane) {
    isDoubtful_[lane] = !seeds_[lane].fitsFloat || leavesSurface(lane) || values_[lane] < kMinFloatDiameter ||
                        hitsItself(lane) || hitsContact(lane);
    if (!seeds_[lane].hits.empty()) writeHits(lane);
  }
}

/// Casts one ray of all cones; coneDirection: one of Cone::directions.
LaneHits EmbreeConeGroup::cast(const Vec3d& coneDirection) {
  float* const rows[] = {packet_.ray.dir_x, packet_.ray.dir_y, packet_.ray.dir_z};
  const Vec3d& d = coneDirection;
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t lane = 0; lane < kWidth; ++lane)
      rows[axis][lane] = static_cast<float>(d.x * frames_.tangents[axis][lane] + d.y * frames_.bitangents[axis][lane] +
                                            d.z * frames_.axes[axis][lane]);
  for (size_t lane = 0; lane < kWidth; ++lane) {
    packet_.ray.tfar[lane] = std::numeric_limits<float>::infinity();
    packet_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    packet_.hit.primID[lane] = kNoFace;
  }
  intersect8(cones_.embree.get(), isActive_.data(), packet_);
  LaneHits hits;
  std::copy_n(packet_.hit.primID, kWidth, hits.primitives.begin());
  std::copy_n(packet_.ray.tfar, kWidth, hits.distances.begin());
  return hits;
}

bool EmbreeConeGroup::leavesSurface(size_t lane) const {
  return seeds_[lane].fitsFloat && cones_.embree.mode() != EmbreeMode::Robust && lanes_.leavesSurface(lane);
}

bool EmbreeConeGroup::hitsItself(size_t lane) const {
  if (seeds_[lane].primitive == kNoFace) return false;
  bool result = false;
  for (const LaneHits& hits : hits_) result |= hits.primitives[lane] == seeds_[lane].primitive;
  return result;
}

/// Whether a ray hit the outer side of a face that touches another one, which the ray should have hit instead.
bool EmbreeConeGroup::hitsContact(size_t lane) const {
  if (!lanes_.leavesSurface(lane)) return false;
  const ConeFrame& frame = seeds_[lane].start.frame;
  for (size_t ray = 0; ray < hits_.size(); ++ray) {
    const uint32_t primitive = hits_[ray].primitives[lane];
    if (primitive != kNoFace && dot(cones_.planes[primitive].normal, frame.toWorld(cones_.cone.directions[ray])) < 0 &&
        cones_.contacts.contain(primitive))
      return true;
  }
  return false;
}

void EmbreeConeGroup::writeHits(size_t lane) const {
  for (size_t ray = 0; ray < hits_.size(); ++ray) {
    const uint32_t primitive = hits_[ray].primitives[lane];
    seeds_[lane].hits[ray] =
        primitive == kNoFace ? kMiss : ConeHit{hits_[ray].distances[lane], cones_.scene.bvh.primitiveFaces[primitive]};
  }
}

}  // namespace asdfvk
