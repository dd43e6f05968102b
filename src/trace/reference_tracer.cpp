#include "trace/reference_tracer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "core/check.h"
#include "core/stopwatch.h"
#include "trace/chunk_size.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

// In normalised units; kNoHit for a dropped ray.
double validDistance(const TraceScene& scene, const Cone& cone, const Vec3d& origin, const Vec3d& direction,
                     uint32_t seedFace) {
  const RayHit hit = nearestHit(scene.bvh, scene.mesh, origin, direction, scene.representatives[seedFace]);
  if (hit.face == kNoFace) return kNoHit;
  const bool isFalse = dot(scene.geometry.normals[seedFace], scene.geometry.normals[hit.face]) > cone.falseHitCosine;
  return isFalse ? kNoHit : hit.distance;
}

class ReferenceTracer final : public ConeTracer {
 public:
  ReferenceTracer(const TraceScene& scene, const Cone& cone) : scene_(scene), cone_(cone) {}

  TraceStatistics trace(std::span<const uint32_t> seedFaces, std::span<double> values,
                        const RunControl& control) override {
    ASDFVK_CHECK_OP(seedFaces.size(), ==, values.size());
    const auto total = static_cast<double>(seedFaces.size());
    ChunkSize chunk(64, seedFaces.size());
    for (size_t begin = 0; begin < seedFaces.size();) {
      control.checkpoint(static_cast<double>(begin) / total);
      const size_t end = std::min<size_t>(begin + chunk.current(), seedFaces.size());
      const Stopwatch stopwatch;
      tbb::parallel_for(tbb::blocked_range<size_t>(begin, end, 8), [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) values[i] = referenceCone(scene_, cone_, seedFaces[i]);
      });
      chunk.adapt(end - begin, stopwatch.seconds());
      begin = end;
    }
    control.checkpoint(1);
    return {.rayCount = seedFaces.size() * cone_.directions.size(), .redoneConeCount = 0};
  }

 private:
  TraceScene scene_;
  const Cone& cone_;
};

}  // namespace

std::unique_ptr<ConeTracer> makeReferenceTracer(const TraceScene& scene, const Cone& cone) {
  return std::make_unique<ReferenceTracer>(scene, cone);
}

double referenceRayLength(const TraceScene& scene, const Cone& cone, const Vec3d& direction, uint32_t seedFace) {
  const Vec3d origin = scene.bvh.normalization.toNormalized(scene.geometry.barycentres[seedFace]);
  const double distance = validDistance(scene, cone, origin, direction, seedFace);
  return distance < kNoHit ? scene.bvh.normalization.toMeshLength(distance) : kNoValue;
}

double referenceCone(const TraceScene& scene, const Cone& cone, uint32_t seedFace) {
  ASDFVK_CHECK(!scene.geometry.isDegenerate(seedFace));
  const ConeFrame frame = coneFrame(-scene.geometry.normals[seedFace]);
  const Vec3d origin = scene.bvh.normalization.toNormalized(scene.geometry.barycentres[seedFace]);
  std::array<double, kMaxRayCount> distances, weights;
  size_t validCount = 0;
  for (size_t i = 0; i < cone.directions.size(); ++i) {
    const Vec3d& d = cone.directions[i];
    const Vec3d direction = d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.axis;
    const double distance = validDistance(scene, cone, origin, direction, seedFace);
    if (!(distance < kNoHit)) continue;
    distances[validCount] = distance;
    weights[validCount] = cone.weights[i];
    ++validCount;
  }
  const double value = coneValue({distances.data(), validCount}, {weights.data(), validCount}, cone.outlierDeviations);
  return scene.bvh.normalization.toMeshLength(value);
}

}  // namespace asdfvk
