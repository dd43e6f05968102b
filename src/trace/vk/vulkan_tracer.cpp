#include "trace/vk/vulkan_tracer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "core/unset_vector.h"
#include "trace/adaptive_chunks.h"
#include "trace/reference_tracer.h"
#include "trace/seed_order.h"
#include "trace/vk/device_seeds.h"
#include "trace/vk/vulkan_cone_chunk.h"
#include "trace/vk/vulkan_cone_kernel.h"

namespace asdfvk {
namespace {

constexpr uint64_t kFirstChunkRayCount = 1u << 20, kFirstChunkRayCountOnCpu = 1u << 16;
constexpr size_t kChunksInFlight = 2;

struct VulkanScene final : EncodedScene {
  explicit VulkanScene(const TraceScene& scene) : bvh(encodeWideBvh(scene.bvh)), seeds(scene, bvh.primitiveFaces) {}

  WideBvh bvh;
  DeviceSeeds seeds;
};

class VulkanTracer final : public ConeTracer {
 public:
  /// encodeSeconds: 0 if the scene was encoded before makeVulkanTracer().
  VulkanTracer(const VulkanConeKernel& kernel, const TraceScene& scene, const Cone& cone, VulkanScene&& encoded,
               double encodeSeconds)
      : kernel_(kernel),
        scene_(scene),
        cone_(cone),
        encodeSeconds_(encodeSeconds),
        seeds_(std::move(encoded.seeds)),
        buffers_(kernel, scene, encoded.bvh, cone) {
    ASDFVK_CHECK_OP(cone.directions.size(), ==, size_t{kernel.rayCount()});
    ASDFVK_CHECK(cone.definition == kernel.definition());
  }

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    const auto startOf = [&](uint32_t i) { return coneStartOfFace(scene_, cone_, seedFaces[i]); };
    const auto submit = [&](ConeChunk& chunk, std::span<const DeviceCone> cones) {
      if (kernel_.origins() == nullptr) return submitStarts(chunk, cones, startOf, results);
      const std::span<ConeSeed> seeds = chunk.seeds();
      forEachInParallel(cones.size(), [&](uint32_t i) {
        const double rotation = coneRotation(cone_, seedFaces[cones[i].index]);
        seeds[i] = {cones[i].seed, static_cast<float>(std::tan(rotation / 2))};
      });
      chunk.submit(pushFor(cones.size()), ConeChunk::Input::Seeds, !results.hits.empty());
    };
    return traceAll(
        seedFaces.size(), [&] { return seeds_.inDeviceOrder(seedFaces); }, submit, startOf, results, control);
  }

  TraceStatistics traceAt(std::span<const ConeStart> starts, const ConeResults& results,
                          const RunControl& control) override {
    const auto startOf = [&](uint32_t i) -> const ConeStart& { return starts[i]; };
    const auto submit = [&](ConeChunk& chunk, std::span<const DeviceCone> cones) {
      submitStarts(chunk, cones, startOf, results);
    };
    const auto sorted = [&] {
      const std::vector<uint32_t> order = spatialOrder(starts);
      UnsetVector<DeviceCone> cones(order.size());
      forEachInParallel(order.size(), [&](uint32_t i) {
        cones[i] = {isNearBox(starts[order[i]].origin) ? 0 : kNoFace, order[i]};
      });
      return cones;
    };
    return traceAll(starts.size(), sorted, submit, startOf, results, control);
  }

  double encodeSeconds() const override { return encodeSeconds_; }

 private:
  /// sorted(): all cones, in the order of the device. submit(chunk, cones): writes the input of these cones and submits
  /// the chunk. startOf(i): the start of cone i.
  template <typename Sorted, typename Submit, typename StartOf>
  TraceStatistics traceAll(size_t coneCount, const Sorted& sorted, const Submit& submit, const StartOf& startOf,
                           const ConeResults& results, const RunControl& control) {
    checkSizes(results, coneCount, kernel_.rayCount());
    ASDFVK_CHECK(results.hits.empty() || kernel_.writesHits());
    const uint64_t rayCount = coneCount * cone_.directions.size();
    if (scene_.bvh.nodes.empty()) {
      std::fill(results.values.begin(), results.values.end(), kNoValue);
      std::fill(results.hits.begin(), results.hits.end(), kMiss);
      return {rayCount, 0};
    }
    UnsetVector<DeviceCone> cones = sorted();
    std::vector<uint32_t> redone;
    const auto fits = [](const DeviceCone& cone) { return cone.seed != kNoFace; };
    if (countInParallel(coneCount, [&](uint32_t i) { return fits(cones[i]); }) < coneCount) {
      const auto firstUnfit = std::stable_partition(cones.begin(), cones.end(), fits);
      std::transform(firstUnfit, cones.end(), std::back_inserter(redone),
                     [](const DeviceCone& cone) { return cone.index; });
      cones.erase(firstUnfit, cones.end());
    }
    const double deviceShare = static_cast<double>(cones.size()) / static_cast<double>(std::max<size_t>(1, coneCount));
    traceOnDevice(cones, submit, results, redone, control.part(0, deviceShare));
    redo(redone, startOf, results, control.part(deviceShare, 1));
    return {rayCount, redone.size()};
  }

  template <typename Submit>
  void traceOnDevice(std::span<const DeviceCone> cones, const Submit& submit, const ConeResults& results,
                     std::vector<uint32_t>& redone, const RunControl& control) {
    const uint64_t largest = largestConeChunk(kernel_);
    const bool isCpu = kernel_.device().facts().isCpu();
    const uint64_t firstRayCount = isCpu ? kFirstChunkRayCountOnCpu : kFirstChunkRayCount;
    const ChunkSize size(std::max<uint64_t>(1, firstRayCount / kernel_.rayCount()), largest,
                         ChunkSize::kTargetSeconds / kChunksInFlight);
    std::array<std::optional<ConeChunk>, kChunksInFlight> chunks;  // Their destructors wait.
    const auto start = [&](size_t slot, size_t begin, size_t end) {
      std::optional<ConeChunk>& chunk = chunks[slot];
      if (!chunk || chunk->capacity() < end - begin) {
        chunk.reset();
        chunk.emplace(kernel_, buffers_, std::min<uint64_t>(std::bit_ceil(end - begin), largest));
      }
      submit(*chunk, cones.subspan(begin, end - begin));
    };
    const auto read = [&](size_t slot, size_t begin, size_t end) {
      readChunk(*chunks[slot], cones.subspan(begin, end - begin), results, redone);
    };
    forEachChunkInFlight<kChunksInFlight>(
        cones.size(), size, control, start, [&](size_t slot) { chunks[slot]->wait(); }, read);
  }

  template <typename StartOf>
  void submitStarts(ConeChunk& chunk, std::span<const DeviceCone> cones, const StartOf& startOf,
                    const ConeResults& results) const {
    const std::span<ConeOrigin> origins = chunk.starts();
    forEachInParallel(cones.size(), [&](uint32_t i) {
      const ConeStart& start = startOf(cones[i].index);
      origins[i] = {
          toGlsl(start.origin), start.skippedFace, toGlsl(start.frame.tangent), 0, toGlsl(start.frame.bitangent), 0};
    });
    chunk.submit(pushFor(cones.size()), ConeChunk::Input::Starts, !results.hits.empty());
  }

  [[nodiscard]] ConePush pushFor(size_t coneCount) const {
    return {static_cast<uint32_t>(coneCount), static_cast<float>(cone_.falseHitCosine),
            static_cast<float>(cone_.outliers.deviations), static_cast<float>(cone_.contactDistance)};
  }

  void readChunk(ConeChunk& chunk, std::span<const DeviceCone> cones, const ConeResults& results,
                 std::vector<uint32_t>& redone) const {
    const std::span<const uint32_t> lengths = chunk.results();
    const auto lengthOf = [&](uint32_t i) -> double {
      return lengths[i] == kNoValueBits ? kNoValue : static_cast<double>(std::bit_cast<float>(lengths[i]));
    };
    const auto isRedone = [&](uint32_t i) {
      return lengths[i] == kIterationLimitBits || lengthOf(i) < kMinFloatDiameter;
    };
    forEachInParallel(cones.size(), [&](uint32_t i) {
      results.values[cones[i].index] = scene_.bvh.normalization.toMeshLength(lengthOf(i));
    });
    for (uint32_t i = 0; i < cones.size(); ++i)
      if (isRedone(i)) redone.push_back(cones[i].index);
    if (!results.hits.empty())
      copyHits(
          cones.size(), [&](uint32_t i) { return cones[i].index; }, chunk.hits(), results.hits);
  }

  /// Copies the hits of cone i to position indexOf(i).
  template <typename IndexOf>
  void copyHits(size_t coneCount, const IndexOf& indexOf, std::span<const ConeHit> from, std::span<ConeHit> to) const {
    const size_t rayCount = kernel_.rayCount();
    forEachInParallel(coneCount, [&](uint32_t i) {
      std::ranges::copy(from.subspan(i * rayCount, rayCount), to.subspan(indexOf(i) * rayCount).begin());
    });
  }

  template <typename StartOf>
  void redo(const std::vector<uint32_t>& redone, const StartOf& startOf, const ConeResults& results,
            const RunControl& control) const {
    const std::unique_ptr<ConeTracer> reference = makeReferenceTracer(scene_, cone_);
    const size_t hitCount = results.hits.empty() ? 0 : kernel_.rayCount();  // Number of hits per cone.
    const size_t blockSize = largestConeChunk(kernel_);                     // Bounds the copies of starts and hits.
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
      if (!results.hits.empty())
        copyHits(
            block.size(), [&](uint32_t i) { return block[i]; }, hits, results.hits);
    }
  }

  const VulkanConeKernel& kernel_;
  TraceScene scene_;
  const Cone& cone_;
  double encodeSeconds_;
  DeviceSeeds seeds_;
  ConeBuffers buffers_;
};

}  // namespace

std::unique_ptr<EncodedScene> encodeForVulkan(const TraceScene& scene) { return std::make_unique<VulkanScene>(scene); }

std::unique_ptr<ConeTracer> makeVulkanTracer(const VulkanConeKernel& kernel, const TraceScene& scene, const Cone& cone,
                                             std::unique_ptr<EncodedScene> encoded) {
  const Stopwatch watch;
  const bool isEncoded = encoded != nullptr;
  if (!isEncoded) encoded = encodeForVulkan(scene);
  return std::make_unique<VulkanTracer>(kernel, scene, cone, std::move(dynamic_cast<VulkanScene&>(*encoded)),
                                        isEncoded ? 0 : watch.seconds());
}

}  // namespace asdfvk
