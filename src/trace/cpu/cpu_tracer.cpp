#include <algorithm>
#include <atomic>

#include "core/check.h"
#include "core/parallel.h"
#include "core/prefetch.h"
#include "trace/adaptive_chunks.h"
#include "trace/cpu/cone_group.h"
#include "trace/reference_tracer.h"
#include "trace/seed_order.h"

namespace asdfvk {
namespace {

constexpr size_t kFirstCpuChunkRayCount = 1u << 16;  // A chunk takes 0.01 to 0.03 s on two cores.

class CpuTracer final : public ConeTracer {
 public:
  CpuTracer(const TraceScene& scene, const Cone& cone)
      : scene_(scene), cone_(cone), seedOrder_(scene), bvh_(encodeLaneBvh(scene.bvh, scene.mesh)) {}

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    if (bvh_.nodes.empty()) return makeReferenceTracer(scene_, cone_)->trace(seedFaces, results, control);
    const auto seedOf = [&](uint32_t i) { return seedAt(seedFaces[i]); };
    const auto prefetchSeed = [&](uint32_t i) { prefetch(seedFaces[i]); };
    return traceAll(seedOrder_.of(seedFaces), seedOf, prefetchSeed, results, control);
  }

  TraceStatistics traceAt(std::span<const ConeStart> starts, const ConeResults& results,
                          const RunControl& control) override {
    if (bvh_.nodes.empty()) return makeReferenceTracer(scene_, cone_)->traceAt(starts, results, control);
    const auto seedOf = [&](uint32_t i) { return CpuSeed{starts[i], kNoFace, isNearBox(starts[i].origin), {}}; };
    const auto prefetchSeed = [&](uint32_t i) { prefetchMemory(&starts[i]); };
    return traceAll(spatialOrder(starts), seedOf, prefetchSeed, results, control);
  }

 private:
  static constexpr size_t kGroupSize = ConeGroup::kWidth;

  [[nodiscard]] CpuSeed seedAt(uint32_t face) const {
    ASDFVK_CHECK(!scene_.geometry.isDegenerate(face));
    const uint32_t primitive = seedOrder_.primitiveOf(face);
    return {
        coneStartOfFace(scene_, cone_, face), primitive, primitive != kNoFace && !isTooSmallForFloat(scene_, face), {}};
  }

  void prefetch(uint32_t face) const {
    prefetchMemory(&scene_.geometry.barycentres[face]);
    prefetchMemory(&scene_.geometry.normals[face]);
    prefetchMemory(&scene_.geometry.areas[face]);
    seedOrder_.prefetch(face);
  }

  /// seedOf(i): cone i without its output array. prefetchSeed(i): prefetches the memory that seedOf(i) reads.
  template <typename SeedOf, typename PrefetchSeed>
  TraceStatistics traceAll(const std::vector<uint32_t>& order, const SeedOf& seedOf, const PrefetchSeed& prefetchSeed,
                           const ConeResults& results, const RunControl& control) {
    const size_t rayCount = cone_.directions.size();
    checkSizes(results, order.size(), rayCount);
    const size_t hitCount = results.hits.empty() ? 0 : rayCount;  // Number of hits per cone.
    const auto hitsOf = [&](uint32_t cone) { return results.hits.subspan(cone * hitCount, hitCount); };
    std::atomic<uint64_t> redoneConeCount = 0;
    const CpuCones cones{scene_, cone_, bvh_};
    PerThread<ConeGroup> groups([&] { return ConeGroup(cones); });
    const size_t groupCount = (order.size() + kGroupSize - 1) / kGroupSize;
    const auto traceGroup = [&](size_t index, ConeGroup& group) {
      const size_t begin = index * kGroupSize, end = std::min(begin + kGroupSize, order.size());
      // While this group is traced, the scattered data of the next group are prefetched.
      for (size_t i = end; i < std::min(end + kGroupSize, order.size()); ++i) prefetchSeed(order[i]);
      group.clear();
      for (size_t i = begin; i < end; ++i) {
        CpuSeed seed = seedOf(order[i]);
        seed.hits = hitsOf(order[i]);
        group.add(seed);
      }
      group.trace();
      redoneConeCount += takeValues(group, std::span(order).subspan(begin, end - begin), results.values);
    };
    const ChunkSize chunk(std::max<size_t>(1, kFirstCpuChunkRayCount / (kGroupSize * rayCount)), groupCount);
    forEachChunk(groupCount, chunk, control, [&](size_t begin, size_t end) {
      forEachRange(end - begin, 1, [&](size_t first, size_t last) {
        ConeGroup& group = groups.local();
        for (size_t i = begin + first; i < begin + last; ++i) traceGroup(i, group);
      });
    });
    return {order.size() * rayCount, redoneConeCount};
  }

  /// Returns the number of cones that the reference traced.
  uint64_t takeValues(const ConeGroup& group, std::span<const uint32_t> cones, std::span<double> values) const {
    uint64_t redoneConeCount = 0;
    for (size_t lane = 0; lane < cones.size(); ++lane) {
      double& value = values[cones[lane]];
      if (group.isDoubtful(lane)) {
        const CpuSeed& seed = group.seed(lane);
        value = referenceCone(scene_, cone_, seed.start, seed.hits);
        ++redoneConeCount;
      } else {
        value = scene_.bvh.normalization.toMeshLength(group.value(lane));
      }
    }
    return redoneConeCount;
  }

  TraceScene scene_;
  const Cone& cone_;
  SeedOrder seedOrder_;
  LaneBvh bvh_;
};

}  // namespace

std::unique_ptr<ConeTracer> makeCpuTracer(const TraceScene& scene, const Cone& cone) {
  return std::make_unique<CpuTracer>(scene, cone);
}

}  // namespace asdfvk
