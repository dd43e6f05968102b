#include "trace/embree_tracer.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/check.h"
#include "core/stopwatch.h"
#include "trace/chunk_size.h"
#include "trace/embree_neighbours.h"
#include "trace/embree_rays.h"
#include "trace/embree_scene.h"
#include "trace/float_limits.h"
#include "trace/reference_tracer.h"
#include "trace/seed_order.h"
#include "trace/slot_planes.h"

namespace asdfvk {
namespace {

constexpr size_t kFirstChunkRayCount = 1u << 16;  // 0.01 to 0.03 s on two cores.

/// Rays begin so far from the seed that float32 cannot take them back to the seed's own face: its plane is off by no
/// more than 2^-22, and rays at the rim meet it latest. (A filter function that passes through the face costs 6 % of
/// all time.) At most as far as the smallest face that is traced in float32 is wide.
double rayStart(const Cone& cone) {
  return std::min(0x1p-22 / std::max(std::cos(cone.halfAngleRadians), 1e-9), kSmallestFloatFace);
}

/// Room for one cone; kept from cone to cone.
struct ConeScratch {
  explicit ConeScratch(size_t rayCount) : rays(rayCount), lengths(rayCount), weights(rayCount) {}
  EmbreeRays rays;
  std::vector<double> lengths, weights;
};

class EmbreeTracer final : public ConeTracer {
 public:
  EmbreeTracer(const TraceScene& scene, const Cone& cone)
      : scene_(scene),
        cone_(cone),
        rayStart_(rayStart(cone)),
        seedOrder_(scene),
        planes_(slotPlanes(scene)),
        embree_(scene) {}

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    const size_t rayCount = cone_.directions.size();
    checkSizes(results, seedFaces.size(), rayCount);
    const size_t hitCount = results.hits.empty() ? 0 : rayCount;  // per cone
    const std::vector<uint32_t> order = seedOrder_.of(seedFaces);
    const auto total = static_cast<double>(order.size());
    std::atomic<uint64_t> redoneConeCount = 0;
    ChunkSize chunk(std::max<size_t>(8, kFirstChunkRayCount / rayCount), order.size());
    for (size_t begin = 0; begin < order.size();) {
      control.checkpoint(static_cast<double>(begin) / total);
      const size_t end = std::min<size_t>(begin + chunk.current(), order.size());
      const Stopwatch stopwatch;
      tbb::parallel_for(tbb::blocked_range<size_t>(begin, end, 8), [&](const tbb::blocked_range<size_t>& range) {
        ConeScratch scratch(rayCount);
        for (size_t i = range.begin(); i < range.end(); ++i) {
          const uint32_t seed = order[i];
          const std::span<ConeHit> hits = results.hits.subspan(seed * hitCount, hitCount);
          if (traceCone(seedFaces[seed], results.values[seed], hits, scratch)) continue;
          results.values[seed] = referenceCone(scene_, cone_, seedFaces[seed], hits);
          ++redoneConeCount;
        }
      });
      chunk.adapt(end - begin, stopwatch.seconds());
      begin = end;
    }
    control.checkpoint(1);
    return {seedFaces.size() * rayCount, redoneConeCount};
  }

 private:
  /// False when the cone is the reference's: too small for float32, or another face is as near as rays begin.
  bool traceCone(uint32_t face, double& value, std::span<ConeHit> hits, ConeScratch& scratch) const {
    ASDFVK_CHECK(!scene_.geometry.isDegenerate(face));
    const uint32_t slot = seedOrder_.slotOf(face);
    const Vec3d origin = scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[face]);
    if (isTooSmallForFloat(scene_, face) || hasNeighbourWithin(embree_, scene_, planes_, origin, slot, rayStart_))
      return false;
    const ConeFrame frame = faceConeFrame(cone_, scene_.geometry.normals[face], face);
    scratch.rays.cast(embree_, cone_, frame, origin, rayStart_);
    const double normalizedValue = valueOf(face, origin, hits, scratch);
    value = scene_.bvh.normalization.toMeshLength(normalizedValue);
    return !(normalizedValue < kShortestFloatDiameter) && !scratch.rays.hasMet(slot);
  }

  /// In normalised units.
  double valueOf(uint32_t face, const Vec3d& origin, std::span<ConeHit> hits, ConeScratch& scratch) const {
    auto& [rays, lengths, weights] = scratch;
    const Vec3d& seedNormal = scene_.geometry.normals[face];
    size_t validCount = 0;
    for (size_t i = 0; i < cone_.directions.size(); ++i) {
      const uint32_t slot = rays.slot(i);
      const bool isMiss = slot == kNoFace;
      if (!hits.empty()) hits[i] = isMiss ? kMiss : ConeHit{rays.distance(i), scene_.bvh.slotFaces[slot]};
      if (isMiss || isFalseHit(cone_, seedNormal, planes_[slot].normal)) continue;
      lengths[validCount] = lengthInDouble(origin, rays.direction(i), planes_[slot], rays.distance(i));
      weights[validCount] = cone_.weights[i];
      ++validCount;
    }
    return coneValue({lengths.data(), validCount}, {weights.data(), validCount}, cone_.outlierDeviations);
  }

  /// Where the plane is not near what Embree says, its triangle is a sliver whose normal tells little.
  static double lengthInDouble(const Vec3d& origin, const Vec3d& direction, const SlotPlane& plane, double distance) {
    constexpr double kPlaneTolerance = 0x1p-14;
    const double length = (plane.offset - dot(plane.normal, origin)) / dot(plane.normal, direction);
    return std::abs(length - distance) <= kPlaneTolerance ? length : distance;
  }

  TraceScene scene_;
  const Cone& cone_;
  double rayStart_;  // In normalised units, as all lengths here.
  SeedOrder seedOrder_;
  std::vector<SlotPlane> planes_;
  EmbreeScene embree_;
};

}  // namespace

bool hasEmbree() { return true; }

void requireEmbree() {}

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
