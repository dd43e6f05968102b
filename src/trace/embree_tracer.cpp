#include "trace/embree_tracer.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/stopwatch.h"
#include "trace/chunk_size.h"
#include "trace/embree_scene.h"
#include "trace/float_limits.h"
#include "trace/reference_tracer.h"
#include "trace/seed_order.h"

namespace asdfvk {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What the filter knows of the ray under way.
struct RayContext : RTCIntersectContext {
  std::span<const uint32_t> slotFaces;
  uint32_t skippedSlot = kNoFace;
  float distance = kInfinity;  ///< To the nearest triangle yet.
  uint32_t slot = kNoFace;     ///< That triangle.
};

/// The accept rule: rays pass through the seed face, and the lowest of equally near faces wins, in whatever order they
/// are met. (Embree keeps every hit that is not farther than the last one kept.)
void filterHit(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] != -1) return;
  auto& context = *static_cast<RayContext*>(arguments->context);
  const uint32_t slot = RTCHitN_primID(arguments->hit, 1, 0);
  const float distance = RTCRayN_tfar(arguments->ray, 1, 0);
  const bool isHigherTie = distance == context.distance && context.slot != kNoFace &&
                           context.slotFaces[slot] > context.slotFaces[context.slot];
  if (slot == context.skippedSlot || isHigherTie) {
    arguments->valid[0] = 0;
    return;
  }
  context.distance = distance;
  context.slot = slot;
}

/// A ray of a cone and what it met.
struct TracedRay {
  Vec3d direction;
  float distance;
  uint32_t face;
};

class EmbreeTracer final : public ConeTracer {
 public:
  EmbreeTracer(const TraceScene& scene, const Cone& cone)
      : scene_(scene), cone_(cone), seedOrder_(scene), embree_(scene, filterHit) {}

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    const size_t rayCount = cone_.directions.size();
    checkSizes(results, seedFaces.size(), rayCount);
    const size_t hitCount = results.hits.empty() ? 0 : rayCount;  // per cone
    const std::vector<uint32_t> order = seedOrder_.of(seedFaces);
    const auto total = static_cast<double>(order.size());
    std::atomic<uint64_t> redoneConeCount = 0;
    ChunkSize chunk(64, order.size());
    for (size_t begin = 0; begin < order.size();) {
      control.checkpoint(static_cast<double>(begin) / total);
      const size_t end = std::min<size_t>(begin + chunk.current(), order.size());
      const Stopwatch stopwatch;
      tbb::parallel_for(tbb::blocked_range<size_t>(begin, end, 8), [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) {
          const uint32_t seed = order[i];
          const std::span<ConeHit> hits = results.hits.subspan(seed * hitCount, hitCount);
          redoneConeCount += !traceCone(seedFaces[seed], results.values[seed], hits);
        }
      });
      chunk.adapt(end - begin, stopwatch.seconds());
      begin = end;
    }
    control.checkpoint(1);
    return {seedFaces.size() * rayCount, redoneConeCount};
  }

 private:
  /// False when the reference traced the cone.
  bool traceCone(uint32_t face, double& value, std::span<ConeHit> hits) const {
    ASDFVK_CHECK(!scene_.geometry.isDegenerate(face));
    if (!isTooSmallForFloat(scene_, face)) {
      const double normalizedValue = valueInFloat(face, hits);
      value = scene_.bvh.normalization.toMeshLength(normalizedValue);
      if (!(normalizedValue < kShortestFloatDiameter)) return true;
    }
    value = referenceCone(scene_, cone_, face, hits);
    return false;
  }

  /// In normalised units.
  double valueInFloat(uint32_t face, std::span<ConeHit> hits) const {
    std::array<TracedRay, kMaxRayCount> rays;
    const Vec3d origin = scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[face]);
    castRays(face, origin, rays);
    const std::vector<Vec3d>& normals = scene_.geometry.normals;
    std::array<double, kMaxRayCount> lengths, weights;
    size_t validCount = 0;
    for (size_t i = 0; i < cone_.directions.size(); ++i) {
      if (!hits.empty()) hits[i] = {rays[i].distance, rays[i].face};
      if (rays[i].face == kNoFace || isFalseHit(cone_, normals[face], normals[rays[i].face])) continue;
      lengths[validCount] = lengthInDouble(origin, rays[i]);
      weights[validCount] = cone_.weights[i];
      ++validCount;
    }
    return coneValue({lengths.data(), validCount}, {weights.data(), validCount}, cone_.outlierDeviations);
  }

  void castRays(uint32_t face, const Vec3d& origin, std::array<TracedRay, kMaxRayCount>& rays) const {
    const ConeFrame frame = faceConeFrame(cone_, scene_.geometry.normals[face], face);
    RayContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    context.slotFaces = scene_.bvh.slotFaces;
    context.skippedSlot = seedOrder_.slotOf(face);
    for (size_t i = 0; i < cone_.directions.size(); ++i) {
      const Vec3d& d = cone_.directions[i];
      const Vec3d direction = d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.axis;
      context.distance = kInfinity;
      context.slot = kNoFace;
      RTCRayHit query;
      query.ray = {static_cast<float>(origin.x),
                   static_cast<float>(origin.y),
                   static_cast<float>(origin.z),
                   0,
                   static_cast<float>(direction.x),
                   static_cast<float>(direction.y),
                   static_cast<float>(direction.z),
                   0,
                   kInfinity,
                   ~0u,
                   0,
                   0};
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(embree_.get(), &context, &query);
      const bool isMiss = context.slot == kNoFace;
      rays[i] = {direction, context.distance, isMiss ? kNoFace : context.slotFaces[context.slot]};
    }
  }

  /// To the plane of the face that was met. Where that is not near what Embree says, the face is a sliver whose normal
  /// tells little.
  double lengthInDouble(const Vec3d& origin, const TracedRay& ray) const {
    const Vec3d& normal = scene_.geometry.normals[ray.face];
    const Vec3d onPlane = scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[ray.face]);
    const double length = dot(normal, onPlane - origin) / dot(normal, ray.direction);
    return std::abs(length - ray.distance) <= kPlaneTolerance ? length : ray.distance;
  }

  static constexpr double kPlaneTolerance = 0x1p-14;  // In normalised units.

  TraceScene scene_;
  const Cone& cone_;
  SeedOrder seedOrder_;
  EmbreeScene embree_;
};

}  // namespace

bool hasEmbree() { return true; }

std::string embreeName() {
  const EmbreeDevice device(rtcNewDevice(nullptr));
  const auto part = [&](RTCDeviceProperty property) { return rtcGetDeviceProperty(device.get(), property); };
  return fmt::format("Embree {}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     part(RTC_DEVICE_PROPERTY_VERSION_MINOR), part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

std::unique_ptr<ConeTracer> makeEmbreeTracer(const TraceScene& scene, const Cone& cone) {
  return std::make_unique<EmbreeTracer>(scene, cone);
}

}  // namespace asdfvk
