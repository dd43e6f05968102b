#include "trace/vulkan/vulkan_tracer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "core/check.h"
#include "core/stopwatch.h"
#include "trace/chunks.h"
#include "trace/reference_tracer.h"
#include "trace/seed_order.h"
#include "trace/vulkan/vulkan_balls.h"
#include "trace/vulkan/vulkan_cone_kernel.h"
#include "vk/command_list.h"

namespace asdfvk {
namespace {

constexpr uint64_t kFirstChunkRayCount = 1u << 16;

class VulkanTracer final : public ConeTracer {
 public:
  VulkanTracer(const VulkanConeKernel& kernel, const TraceScene& scene, const Cone& cone)
      : kernel_(kernel),
        scene_(scene),
        cone_(cone),
        seedOrder_(scene),
        buffers_(kernel, encode(), cone),
        commands_(kernel.device()) {
    ASDFVK_CHECK_OP(cone.directions.size(), ==, size_t{kernel.rayCount()});
    ASDFVK_CHECK(cone.definition == kernel.definition());
  }

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    return traceAll(
        seedOrder_.of(seedFaces), [&](uint32_t i) { return coneStartOfFace(scene_, cone_, seedFaces[i]); },
        [&](uint32_t i) { return !isTooSmallForFloat(scene_, seedFaces[i]); }, results, control);
  }

  TraceStatistics traceAt(std::span<const ConeStart> starts, const ConeResults& results,
                          const RunControl& control) override {
    return traceAll(
        spatialOrder(starts), [&](uint32_t i) -> const ConeStart& { return starts[i]; },
        [&](uint32_t i) { return isNearBox(starts[i].origin); }, results, control);
  }

  std::unique_ptr<BallShrinker> makeBallShrinker(const OpposingWalls& walls) override {
    ASDFVK_CHECK(kernel_.balls() != nullptr);
    return makeVulkanBallShrinker(kernel_, buffers_, scene_, walls);
  }

  double encodeSeconds() const override { return encodeSeconds_; }

 private:
  DeviceBvh encode() {
    DeviceBvh bvh = encodeDeviceBvh(scene_.bvh, scene_.mesh, scene_.geometry, kernel_.choice().bvh);
    if (kernel_.balls() != nullptr) bvh.addNormalBounds(scene_.geometry);
    encodeSeconds_ = watch_.seconds();
    return bvh;
  }

  /// order: of the cones on the device. startOf(i): the start of cone i. fitsFloat(i): whether the device can trace it.
  template <typename StartOf, typename FitsFloat>
  TraceStatistics traceAll(std::vector<uint32_t> order, const StartOf& startOf, const FitsFloat& fitsFloat,
                           const ConeResults& results, const RunControl& control) {
    const size_t coneCount = order.size();
    checkSizes(results, coneCount, kernel_.rayCount());
    ASDFVK_CHECK(results.hits.empty() || kernel_.writesHits());
    const uint64_t rayCount = coneCount * cone_.directions.size();
    if (scene_.bvh.nodes.empty()) {
      std::fill(results.values.begin(), results.values.end(), kNoValue);
      std::fill(results.hits.begin(), results.hits.end(), kMiss);
      return {rayCount, 0};
    }
    const auto firstUnfit = std::stable_partition(order.begin(), order.end(), fitsFloat);
    std::vector<uint32_t> redone(firstUnfit, order.end());
    order.erase(firstUnfit, order.end());
    const double deviceShare = static_cast<double>(order.size()) / static_cast<double>(std::max<size_t>(1, coneCount));
    traceOnDevice(order, startOf, results, redone, control.part(0, deviceShare));
    redo(redone, startOf, results, control.part(deviceShare, 1));
    return {rayCount, redone.size()};
  }

  template <typename StartOf>
  void traceOnDevice(const std::vector<uint32_t>& order, const StartOf& startOf, const ConeResults& results,
                     std::vector<uint32_t>& redone, const RunControl& control) {
    const ChunkSize chunk(std::max<uint64_t>(1, kFirstChunkRayCount / kernel_.rayCount()), largestConeChunk(kernel_));
    forEachChunk(order.size(), chunk, control, [&](size_t begin, size_t end) {
      const std::span<const uint32_t> cones = std::span(order).subspan(begin, end - begin);
      writeOrigins(cones, startOf);
      dispatch(static_cast<uint32_t>(cones.size()));
      readChunk(cones, results, redone);
    });
  }

  template <typename StartOf>
  void writeOrigins(std::span<const uint32_t> order, const StartOf& startOf) {
    const std::span<ConeOrigin> origins = buffers_.origins.mappedAs<ConeOrigin>();
    tbb::parallel_for(size_t{0}, order.size(), [&](size_t i) {
      const ConeStart& start = startOf(order[i]);
      origins[i] = {
          toGlsl(start.origin), start.skippedFace, toGlsl(start.frame.tangent), 0, toGlsl(start.frame.bitangent), 0};
    });
  }

  void dispatch(uint32_t coneCount) {
    const ConePush push{coneCount, static_cast<float>(cone_.falseHitCosine),
                        static_cast<float>(cone_.outliers.deviations)};
    const auto groupCount = [](uint32_t count, uint32_t perGroup) { return (count + perGroup - 1) / perGroup; };
    const VulkanWorkgroupShape& shape = kernel_.shape();
    commands_.begin();
    commands_.dispatch(kernel_.pipeline(), buffers_.bindings, bytesOf(push),
                       groupCount(push.coneCount, shape.conesPerWorkgroup),
                       kernel_.reduction() ? groupCount(kernel_.rayCount(), shape.lanesPerCone) : 1);
    commands_.barrier();
    if (kernel_.reduction()) {
      commands_.dispatch(*kernel_.reduction(), *buffers_.reductionBindings, bytesOf(push),
                         groupCount(push.coneCount, VulkanConeKernel::kReductionLaneCount));
      commands_.barrier();
    }
    commands_.submitAndWait();
  }

  void readChunk(std::span<const uint32_t> order, const ConeResults& results, std::vector<uint32_t>& redone) const {
    const std::span<const uint32_t> lengths = buffers_.results.mappedAs<uint32_t>();
    for (size_t i = 0; i < order.size(); ++i) {
      const double length = lengths[i] == kNoValueBits ? kNoValue : std::bit_cast<float>(lengths[i]);
      if (lengths[i] == kIterationLimitBits || length < kMinFloatDiameter) redone.push_back(order[i]);
      results.values[order[i]] = scene_.bvh.normalization.toMeshLength(length);
    }
    if (!results.hits.empty()) copyHits(order, buffers_.hits.mappedAs<ConeHit>(), results.hits);
  }

  /// Copies the hits of each cone to its position in `order`.
  void copyHits(std::span<const uint32_t> order, std::span<const ConeHit> from, std::span<ConeHit> to) const {
    const size_t rayCount = kernel_.rayCount();
    tbb::parallel_for(size_t{0}, order.size(), [&](size_t i) {
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * rayCount), rayCount,
                  to.begin() + static_cast<std::ptrdiff_t>(order[i] * rayCount));
    });
  }

  template <typename StartOf>
  void redo(const std::vector<uint32_t>& redone, const StartOf& startOf, const ConeResults& results,
            const RunControl& control) const {
    const std::unique_ptr<ConeTracer> reference = makeReferenceTracer(scene_, cone_);
    const size_t hitCount = results.hits.empty() ? 0 : kernel_.rayCount();  // per cone
    const size_t blockSize = largestConeChunk(kernel_);                     // bounds the copies of starts and hits
    const auto total = static_cast<double>(redone.size());
    for (size_t begin = 0; begin < redone.size(); begin += blockSize) {
      const std::span<const uint32_t> block =
          std::span(redone).subspan(begin, std::min(blockSize, redone.size() - begin));
      std::vector<ConeStart> starts;
      starts.reserve(block.size());
      for (const uint32_t i : block) starts.push_back(startOf(i));
      std::vector<double> values(block.size());
      std::vector<ConeHit> hits(block.size() * hitCount);
      reference->traceAt(
          starts, {values, hits},
          control.part(static_cast<double>(begin) / total, static_cast<double>(begin + block.size()) / total));
      for (size_t i = 0; i < block.size(); ++i) results.values[block[i]] = values[i];
      if (hitCount > 0) copyHits(block, hits, results.hits);
    }
  }

  const VulkanConeKernel& kernel_;
  TraceScene scene_;
  const Cone& cone_;
  Stopwatch watch_;
  double encodeSeconds_ = 0;
  SeedOrder seedOrder_;
  ConeBuffers buffers_;
  CommandList commands_;
};

}  // namespace

std::unique_ptr<ConeTracer> makeVulkanTracer(const VulkanConeKernel& kernel, const TraceScene& scene,
                                             const Cone& cone) {
  return std::make_unique<VulkanTracer>(kernel, scene, cone);
}

}  // namespace asdfvk
