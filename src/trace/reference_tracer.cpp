#include "trace/reference_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cone/cone_value.h"
#include "core/check.h"
#include "core/parallel.h"
#include "trace/adaptive_chunks.h"

namespace asdfvk {
namespace {

/// Rays from farther origins have no hits, because rounding moves their entry into the box by more than 2^-20.
constexpr double kFarthestOrigin = 0x1p32;

/// Distance at which a ray enters the slightly enlarged box [-1, 1]^3; kNoHit for a miss.
double entryIntoBox(const Vec3d& origin, const Vec3d& direction) {
  constexpr double kSide = 1 + 0x1p-7;
  double enter = 0, leave = kNoHit;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    if (d == 0) {
      if (!(std::abs(origin[axis]) <= kSide)) return kNoHit;
      continue;
    }
    const double a = (-kSide - origin[axis]) / d, b = (kSide - origin[axis]) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : kNoHit;
}

bool isValid(const TraceScene& scene, const Cone& cone, const Vec3d& direction, const Vec3d& normal,
             const RayHit& hit) {
  return hit.face != kNoFace && !isFalseHit(cone, normal, direction, scene.geometry.normals[hit.face]);
}

class ReferenceTracer final : public ConeTracer {
 public:
  ReferenceTracer(const TraceScene& scene, const Cone& cone) : scene_(scene), cone_(cone) {}

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    return traceAll(seedFaces, results, control);
  }

  TraceStatistics traceAt(std::span<const ConeStart> starts, const ConeResults& results,
                          const RunControl& control) override {
    return traceAll(starts, results, control);
  }

 private:
  /// cones: faces or starts.
  template <typename Cones>
  TraceStatistics traceAll(const Cones& cones, const ConeResults& results, const RunControl& control) const {
    const size_t rayCount = cone_.directions.size();
    checkSizes(results, cones.size(), rayCount);
    const size_t hitCount = results.hits.empty() ? 0 : rayCount;  // Number of hits per cone.
    forEachChunk(cones.size(), ChunkSize(64, cones.size()), control, [&](size_t begin, size_t end) {
      forEachRange(end - begin, 8, [&](size_t first, size_t last) {
        for (size_t i = begin + first; i < begin + last; ++i)
          results.values[i] = referenceCone(scene_, cone_, cones[i], results.hits.subspan(i * hitCount, hitCount));
      });
    });
    return {.rayCount = cones.size() * rayCount, .redoneConeCount = 0};
  }

  TraceScene scene_;
  const Cone& cone_;
};

}  // namespace

RayHit nearestHitFromAnywhere(const TraceScene& scene, const Vec3d& origin, const Vec3d& direction,
                              uint32_t skippedFace, double contactDistance) {
  if (isNearBox(origin)) return nearestHit(scene.bvh, scene.mesh, origin, direction, skippedFace, contactDistance);
  if (!(std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)}) <= kFarthestOrigin)) return {};
  const double entry = entryIntoBox(origin, direction);
  const Vec3d entered = origin + entry * direction;
  if (!isNearBox(entered)) return {};  // The ray misses the box.
  RayHit hit = nearestHit(scene.bvh, scene.mesh, entered, direction, skippedFace, contactDistance);
  hit.distance += entry;
  return hit;
}

std::unique_ptr<ConeTracer> makeReferenceTracer(const TraceScene& scene, const Cone& cone) {
  return std::make_unique<ReferenceTracer>(scene, cone);
}

double referenceCone(const TraceScene& scene, const Cone& cone, const ConeStart& start, std::span<ConeHit> hits) {
  std::array<double, kMaxRayCount> distances, weights;
  size_t validCount = 0;
  for (size_t i = 0; i < cone.directions.size(); ++i) {
    const Vec3d direction = start.frame.toWorld(cone.directions[i]);
    const RayHit hit = nearestHitFromAnywhere(scene, start.origin, direction, start.skippedFace, cone.contactDistance);
    if (!hits.empty()) hits[i] = {static_cast<float>(hit.distance), hit.face};
    if (!isValid(scene, cone, direction, start.normal, hit)) continue;
    distances[validCount] = hit.distance;
    weights[validCount] = cone.weights[i];
    ++validCount;
  }
  const double value = coneValue({distances.data(), validCount}, {weights.data(), validCount}, cone.outliers);
  return scene.bvh.normalization.toMeshLength(value);
}

double referenceCone(const TraceScene& scene, const Cone& cone, uint32_t seedFace, std::span<ConeHit> hits) {
  ASDFVK_CHECK(!scene.geometry.isDegenerate(seedFace));
  return referenceCone(scene, cone, coneStartOfFace(scene, cone, seedFace), hits);
}

}  // namespace asdfvk
