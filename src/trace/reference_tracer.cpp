#include "trace/reference_tracer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>

#include "core/check.h"
#include "trace/chunks.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

RayHit hitOf(const TraceScene& scene, const Vec3d& origin, const Vec3d& direction, uint32_t seedFace) {
  return nearestHit(scene.bvh, scene.mesh, origin, direction, scene.representatives[seedFace]);
}

bool isValid(const TraceScene& scene, const Cone& cone, const Vec3d& direction, uint32_t seedFace, const RayHit& hit) {
  const std::vector<Vec3d>& normals = scene.geometry.normals;
  return hit.face != kNoFace && !isFalseHit(cone, normals[seedFace], direction, normals[hit.face]);
}

class ReferenceTracer final : public ConeTracer {
 public:
  ReferenceTracer(const TraceScene& scene, const Cone& cone) : scene_(scene), cone_(cone) {}

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    const size_t rayCount = cone_.directions.size();
    checkSizes(results, seedFaces.size(), rayCount);
    const size_t hitCount = results.hits.empty() ? 0 : rayCount;  // per cone
    forEachChunk(seedFaces.size(), ChunkSize(64, seedFaces.size()), control, [&](size_t begin, size_t end) {
      tbb::parallel_for(tbb::blocked_range<size_t>(begin, end, 8), [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i < range.end(); ++i)
          results.values[i] = referenceCone(scene_, cone_, seedFaces[i], results.hits.subspan(i * hitCount, hitCount));
      });
    });
    return {.rayCount = seedFaces.size() * rayCount, .redoneConeCount = 0};
  }

  std::unique_ptr<BallShrinker> makeBallShrinker(const OpposingWalls& walls) override {
    return makeReferenceBallShrinker(scene_, walls);
  }

 private:
  TraceScene scene_;
  const Cone& cone_;
};

}  // namespace

ConeFrame seedConeFrame(const TraceScene& scene, const Cone& cone, uint32_t face) {
  const Vec3d& normal = scene.geometry.normals[face];
  if (cone.definition == Definition::Paper) return faceConeFrame(cone, normal, face);
  // From the corners as they are: scaled or moved ones lose coordinates of the normal that are exactly 0.
  const auto [i, j, k] = scene.mesh.faces[face];
  const Vec3d& a = scene.mesh.vertices[i];
  const Vec3d inward = -cross(scene.mesh.vertices[j] - a, scene.mesh.vertices[k] - a);
  const double norm = length(inward);  // Out of range in extreme units.
  return cgalConeFrame(norm > 0 && std::isfinite(norm) ? inward : -normal);
}

std::unique_ptr<ConeTracer> makeReferenceTracer(const TraceScene& scene, const Cone& cone) {
  return std::make_unique<ReferenceTracer>(scene, cone);
}

double referenceRayLength(const TraceScene& scene, const Cone& cone, const Vec3d& direction, uint32_t seedFace) {
  const Vec3d origin = scene.originOf(seedFace);
  const RayHit hit = hitOf(scene, origin, direction, seedFace);
  return isValid(scene, cone, direction, seedFace, hit) ? scene.bvh.normalization.toMeshLength(hit.distance) : kNoValue;
}

double referenceCone(const TraceScene& scene, const Cone& cone, uint32_t seedFace, std::span<ConeHit> hits) {
  ASDFVK_CHECK(!scene.geometry.isDegenerate(seedFace));
  const ConeFrame frame = seedConeFrame(scene, cone, seedFace);
  const Vec3d origin = scene.originOf(seedFace);
  std::array<double, kMaxRayCount> distances, weights;
  size_t validCount = 0;
  for (size_t i = 0; i < cone.directions.size(); ++i) {
    const Vec3d direction = frame.toWorld(cone.directions[i]);
    const RayHit hit = hitOf(scene, origin, direction, seedFace);
    if (!hits.empty()) hits[i] = {static_cast<float>(hit.distance), hit.face};
    if (!isValid(scene, cone, direction, seedFace, hit)) continue;
    distances[validCount] = hit.distance;
    weights[validCount] = cone.weights[i];
    ++validCount;
  }
  const double value = coneValue({distances.data(), validCount}, {weights.data(), validCount}, cone.outliers);
  return scene.bvh.normalization.toMeshLength(value);
}

}  // namespace asdfvk
