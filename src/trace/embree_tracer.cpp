#include "trace/embree_tracer.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/check.h"
#include "core/stopwatch.h"
#include "trace/chunk_size.h"
#include "trace/embree_cones.h"
#include "trace/embree_neighbours.h"
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

class EmbreeTracer final : public ConeTracer {
 public:
  EmbreeTracer(const TraceScene& scene, const Cone& cone)
      : scene_(scene),
        cone_(cone),
        rayStart_(rayStart(cone)),
        seedOrder_(scene),
        planes_(slotPlanes(scene)),
        embree_(std::make_unique<EmbreeScene>(scene, EmbreeMode::Fastest)) {
    if (seemsToNeedRobustMode()) embree_ = std::make_unique<EmbreeScene>(scene, EmbreeMode::Robust);
  }

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    const size_t rayCount = cone_.directions.size();
    checkSizes(results, seedFaces.size(), rayCount);
    const std::vector<uint32_t> order = seedOrder_.of(seedFaces);
    const Task task{order, seedFaces, results};
    const auto total = static_cast<double>(order.size());
    std::atomic<uint64_t> redoneConeCount = 0;
    ChunkSize chunk(std::max<size_t>(kGroupSize, kFirstChunkRayCount / rayCount), order.size());
    for (size_t begin = 0; begin < order.size();) {
      control.checkpoint(static_cast<double>(begin) / total);
      const size_t end = std::min<size_t>(begin + chunk.current(), order.size());
      const Stopwatch stopwatch;
      tbb::parallel_for(tbb::blocked_range<size_t>(begin, end, 4 * kGroupSize),
                        [&](const tbb::blocked_range<size_t>& range) {
                          redoneConeCount += traceCones(task, range.begin(), range.end());
                        });
      chunk.adapt(end - begin, stopwatch.seconds());
      begin = end;
    }
    control.checkpoint(1);
    return {seedFaces.size() * rayCount, redoneConeCount};
  }

 private:
  static constexpr size_t kGroupSize = EmbreeConeGroup::kWidth;

  struct Task {
    std::span<const uint32_t> order, seedFaces;
    const ConeResults& results;
    [[nodiscard]] std::span<ConeHit> hitsOf(size_t seed, size_t rayCount) const {
      return results.hits.empty() ? results.hits : results.hits.subspan(seed * rayCount, rayCount);
    }
  };

  /// The cones at [begin, end) of the task's order. Returns how many of them the reference traced.
  uint64_t traceCones(const Task& task, size_t begin, size_t end) const {
    const EmbreeCones cones{scene_, cone_, planes_, *embree_, rayStart_};
    EmbreeConeGroup group(cones);
    std::array<uint32_t, kGroupSize> seeds;  // Of the lanes of the group.
    uint64_t redoneConeCount = 0;
    const auto redo = [&](uint32_t seed) {
      task.results.values[seed] =
          referenceCone(scene_, cone_, task.seedFaces[seed], task.hitsOf(seed, cone_.directions.size()));
      ++redoneConeCount;
    };
    for (size_t i = begin; i < end;) {
      group.clear();
      for (; i < end && group.size() < kGroupSize; ++i) {
        const uint32_t seed = task.order[i], face = task.seedFaces[seed];
        if (!isFit(face)) {
          redo(seed);
          continue;
        }
        seeds[group.size()] = seed;
        group.add({face, seedOrder_.slotOf(face), task.hitsOf(seed, cone_.directions.size())});
      }
      group.trace();
      for (size_t lane = 0; lane < group.size(); ++lane) {
        const double value = group.value(lane);
        if (group.isDoubtful(lane) || value < kShortestFloatDiameter)
          redo(seeds[lane]);
        else
          task.results.values[seeds[lane]] = scene_.bvh.normalization.toMeshLength(value);
      }
    }
    return redoneConeCount;
  }

  /// Whether float32 will do for the cone: no when its face is too small, or another is as near as rays begin.
  [[nodiscard]] bool isFit(uint32_t face) const {
    ASDFVK_CHECK(!scene_.geometry.isDegenerate(face));
    const Vec3d origin = scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[face]);
    return !isTooSmallForFloat(scene_, face) &&
           !hasNeighbourWithin(scene_, planes_, origin, seedOrder_.slotOf(face), rayStart_);
  }

  /// Whether so many cones of a sample are doubtful outside of robust mode, as those of an open or crossing surface
  /// are, that tracing them again would take longer than robust mode does.
  [[nodiscard]] bool seemsToNeedRobustMode() const {
    constexpr size_t kSampleSize = 64, kBearableCount = 1;
    EmbreeConeGroup group({scene_, cone_, planes_, *embree_, rayStart_});
    const std::vector<uint32_t>& faces = scene_.bvh.slotFaces;
    const size_t count = std::min(kSampleSize, faces.size());
    size_t doubtfulCount = 0;
    for (size_t i = 0; i < count;) {
      group.clear();
      for (; i < count && group.size() < kGroupSize; ++i) {
        const size_t slot = i * faces.size() / count;
        group.add({faces[slot], static_cast<uint32_t>(slot), {}});
      }
      group.trace();
      for (size_t lane = 0; lane < group.size(); ++lane) doubtfulCount += group.isDoubtful(lane);
    }
    return doubtfulCount > kBearableCount;
  }

  TraceScene scene_;
  const Cone& cone_;
  double rayStart_;  // In normalised units, as all lengths here.
  SeedOrder seedOrder_;
  std::vector<SlotPlane> planes_;
  std::unique_ptr<EmbreeScene> embree_;
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
