#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "trace/chunks.h"
#include "trace/embree/embree_cones.h"
#include "trace/reference_tracer.h"
#include "trace/seed_order.h"

namespace asdfvk {
namespace {

constexpr size_t kFirstEmbreeChunkRayCount = 1u << 16;  // 0.01 to 0.03 s on two cores.

/// Distance from the barycentre at which rays start, so that rounding to float32 cannot make them hit the seed face:
/// its plane is off by at most 2^-22, and rays at the rim of the cone cross it last. At most the width of the smallest
/// face that is traced in float32. (A filter function that skips the face costs 6 % of the time.)
double rayStart(const Cone& cone) {
  return std::min(0x1p-22 / std::max(std::cos(cone.halfAngleRadians), 1e-9), kMinFloatFace);
}

class EmbreeTracer final : public ConeTracer {
 public:
  EmbreeTracer(const TraceScene& scene, const Cone& cone)
      : scene_(scene),
        cone_(cone),
        rayStart_(rayStart(cone)),
        seedOrder_(scene),
        planes_(trianglePlanes(scene)),
        embree_(std::make_unique<EmbreeScene>(scene, EmbreeMode::Fastest)) {
    if (!needsRobustMode()) return;
    embree_.reset();  // Before the second one is built: less memory at the peak.
    embree_ = std::make_unique<EmbreeScene>(scene, EmbreeMode::Robust);
  }

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    const size_t rayCount = cone_.directions.size();
    checkSizes(results, seedFaces.size(), rayCount);
    const std::vector<uint32_t> order = seedOrder_.of(seedFaces);
    const Task task{order, seedFaces, results, results.hits.empty() ? 0 : rayCount};
    std::atomic<uint64_t> redoneConeCount = 0;
    const EmbreeCones cones{scene_, cone_, planes_, *embree_, rayStart_};
    tbb::enumerable_thread_specific<EmbreeConeGroup> groups([&] { return EmbreeConeGroup(cones); });
    const size_t groupCount = (order.size() + kGroupSize - 1) / kGroupSize;
    const ChunkSize chunk(std::max<size_t>(1, kFirstEmbreeChunkRayCount / (kGroupSize * rayCount)), groupCount);
    forEachChunk(groupCount, chunk, control, [&](size_t begin, size_t end) {
      tbb::parallel_for(tbb::blocked_range<size_t>(begin, end), [&](const tbb::blocked_range<size_t>& range) {
        EmbreeConeGroup& group = groups.local();
        for (size_t i = range.begin(); i < range.end(); ++i) redoneConeCount += traceGroup(task, i, group);
      });
    });
    return {seedFaces.size() * rayCount, redoneConeCount};
  }

  std::unique_ptr<BallShrinker> makeBallShrinker(const OpposingWalls& walls) override {
    return makeReferenceBallShrinker(scene_, walls);
  }

 private:
  static constexpr size_t kGroupSize = EmbreeConeGroup::kWidth;

  struct Task {
    std::span<const uint32_t> order, seedFaces;
    const ConeResults& results;
    size_t hitCount;  // Per cone; 0 when hits are not written.
  };

  /// Traces the cones of a group of the task's order. Returns the number of cones that the reference traced.
  uint64_t traceGroup(const Task& task, size_t index, EmbreeConeGroup& group) const {
    const std::span<const uint32_t> order = task.order, seedFaces = task.seedFaces;
    const auto hitsOf = [&](uint32_t seed) { return task.results.hits.subspan(seed * task.hitCount, task.hitCount); };
    const size_t begin = index * kGroupSize, end = std::min(begin + kGroupSize, order.size());
    prefetch(task, end);
    group.clear();
    for (size_t i = begin; i < end; ++i) {
      const uint32_t face = seedFaces[order[i]];
      ASDFVK_CHECK(!scene_.geometry.isDegenerate(face));
      group.add({face, seedOrder_.primitiveOf(face), hitsOf(order[i])});
    }
    group.trace();
    uint64_t redoneConeCount = 0;
    for (size_t lane = 0; lane < group.size(); ++lane) {
      const uint32_t seed = order[begin + lane];
      double& value = task.results.values[seed];
      if (group.isDoubtful(lane)) {
        value = referenceCone(scene_, cone_, seedFaces[seed], hitsOf(seed));
        ++redoneConeCount;
      } else {
        value = scene_.bvh.normalization.toMeshLength(group.value(lane));
      }
    }
    return redoneConeCount;
  }

  /// Prefetches the scattered data of the next group's seeds while a group is traced.
  void prefetch(const Task& task, size_t begin) const {
    for (size_t i = begin; i < std::min(begin + kGroupSize, task.order.size()); ++i) {
      const uint32_t face = task.seedFaces[task.order[i]];
      __builtin_prefetch(&scene_.geometry.barycentres[face]);
      __builtin_prefetch(&scene_.geometry.normals[face]);
      __builtin_prefetch(&scene_.geometry.areas[face]);
      seedOrder_.prefetch(face);
    }
  }

  /// Whether many cones of a sample leave the surface, as on an open or self-intersecting mesh, so that tracing them
  /// again with the reference would take longer than robust mode.
  [[nodiscard]] bool needsRobustMode() const {
    constexpr size_t kSampleSize = 64, kMaxLeavingCount = 1;
    EmbreeConeGroup group({scene_, cone_, planes_, *embree_, rayStart_});
    const std::vector<uint32_t>& faces = scene_.bvh.primitiveFaces;
    const size_t count = std::min(kSampleSize, faces.size());
    size_t leavingCount = 0;
    for (size_t i = 0; i < count;) {
      group.clear();
      for (; i < count && group.size() < kGroupSize; ++i) {
        const size_t primitive = i * faces.size() / count;
        group.add({faces[primitive], static_cast<uint32_t>(primitive), {}});
      }
      group.trace();
      for (size_t lane = 0; lane < group.size(); ++lane) leavingCount += group.leavesSurface(lane);
    }
    return leavingCount > kMaxLeavingCount;
  }

  TraceScene scene_;
  const Cone& cone_;
  double rayStart_;  // In normalised units, as all lengths here.
  SeedOrder seedOrder_;
  std::vector<TrianglePlane> planes_;
  std::unique_ptr<EmbreeScene> embree_;
};

}  // namespace

bool hasEmbree() { return true; }

std::string embreeName() {
  const EmbreeDevice device(rtcNewDevice(nullptr));
  if (!device) throw Error(ErrorCode::EmbreeFailed, "Embree cannot create a device");
  const auto part = [&](RTCDeviceProperty property) { return rtcGetDeviceProperty(device.get(), property); };
  return fmt::format("Embree {}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     part(RTC_DEVICE_PROPERTY_VERSION_MINOR), part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

std::unique_ptr<ConeTracer> makeEmbreeTracer(const TraceScene& scene, const Cone& cone) {
  return std::make_unique<EmbreeTracer>(scene, cone);
}

}  // namespace asdfvk
