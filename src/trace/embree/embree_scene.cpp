#include "trace/embree/embree_scene.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <new>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

/// Throws what Embree has to complain about, if anything; null: of no device.
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
  const std::vector<uint32_t>& slotFaces = scene.bvh.slotFaces;
  auto* points = static_cast<FloatPoint*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(FloatPoint), vertices.size()));
  auto* triangles = static_cast<Face*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Face), slotFaces.size()));
  if (points == nullptr || triangles == nullptr) return;  // The device holds the error.
  tbb::parallel_for(size_t{0}, vertices.size(), [&](size_t i) {
    const Vec3d p = scene.bvh.normalization.toNormalized(vertices[i]);
    points[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  });
  tbb::parallel_for(size_t{0}, slotFaces.size(), [&](size_t i) { triangles[i] = scene.mesh.faces[slotFaces[i]]; });
}

}  // namespace

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

}  // namespace asdfvk
