#include "baselines.h"

#ifdef ASDFVK_HAS_EMBREE
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <limits>
#include <numeric>
#include <vector>

#include "embree_api.h"
#endif

namespace asdfvk::bench {

#ifdef ASDFVK_HAS_EMBREE
namespace {

class EmbreeBaselineScene final : public EmbreeBaseline {
 public:
  EmbreeBaselineScene(const TraceScene& scene, std::span<const uint32_t> faces, const Cone& cone,
                      const EmbreeMode& mode)
      : scene_(scene), cone_(cone), device_(rtcNewDevice(mode.deviceConfig)), embree_(rtcNewScene(device_)) {
    if (mode.isRobust) rtcSetSceneFlags(embree_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<Vec3f*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               sizeof(Vec3f), scene.mesh.vertices.size()));
    auto* triangles = static_cast<Face*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Face), faces.size()));
    tbb::parallel_for(size_t{0}, scene.mesh.vertices.size(), [&](size_t i) {
      points[i] = Vec3f(scene.bvh.normalization.toNormalized(scene.mesh.vertices[i]));
    });
    tbb::parallel_for(size_t{0}, faces.size(), [&](size_t i) { triangles[i] = scene.mesh.faces[faces[i]]; });
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree_, geometry, 0);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree_);
  }
  ~EmbreeBaselineScene() override {
    rtcReleaseScene(embree_);
    rtcReleaseDevice(device_);
  }
  EmbreeBaselineScene(const EmbreeBaselineScene&) = delete;
  EmbreeBaselineScene& operator=(const EmbreeBaselineScene&) = delete;

  double trace(std::span<const uint32_t> seedFaces) const override {
    std::vector<double> sums(seedFaces.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, seedFaces.size(), 8), [&](const tbb::blocked_range<size_t>& range) {
      for (size_t i = range.begin(); i < range.end(); ++i) sums[i] = sumOfLengths(seedFaces[i]);
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

 private:
  double sumOfLengths(uint32_t face) const {
    const ConeFrame frame = paperConeFrame(cone_, scene_.geometry.normals[face], face);
    const Vec3f origin(scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[face]));
    double sum = 0;
    for (const Vec3d& d : cone_.directions) {
      const Vec3f direction(d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.axis);
      RTCRayHit query;
      query.ray = {origin.x,    origin.y,    origin.z,
                   1e-6f,       direction.x, direction.y,
                   direction.z, 0,           std::numeric_limits<float>::infinity(),
                   ~0u,         0,           0};
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      intersect1(embree_, query);
      if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) sum += query.ray.tfar;
    }
    return sum;
  }

  TraceScene scene_;
  const Cone& cone_;
  RTCDevice device_;
  RTCScene embree_;
};

}  // namespace

std::unique_ptr<EmbreeBaseline> makeEmbreeBaseline(const TraceScene& scene, std::span<const uint32_t> faces,
                                                   const Cone& cone, const EmbreeMode& mode) {
  return std::make_unique<EmbreeBaselineScene>(scene, faces, cone, mode);
}

#else
std::unique_ptr<EmbreeBaseline> makeEmbreeBaseline(const TraceScene&, std::span<const uint32_t>, const Cone&,
                                                   const EmbreeMode&) {
  return {};
}
#endif

}  // namespace asdfvk::bench
