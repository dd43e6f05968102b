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
#include "trace/vk/vulkan_hits.h"

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
    const auto write = [&](ConeChunk& chunk, std::span<const DeviceCone> cones) {
      if (kernel_.origins() == nullptr) return writeStarts(chunk, cones, startOf);
      const std::span<ConeSeed> seeds = chunk.seeds();
      forEachInParallel(cones.size(), [&](uint32_t i) {
        const double rotation = coneRotation(cone_, seedFaces[cones[i].index]);
        seeds[i] = {cones[i].seed, static_cast<float>(std::tan(rotation / 2))};
      });
      return ConeChunk::Input::Seeds;
    };
    return traceAll(
        seedFaces.size(), [&] { return seeds_.inDeviceOrder(seedFaces); }, write, startOf, results, control);
  }

  TraceStatistics traceAt(std::span<const ConeStart> starts, const ConeResults& results,
                          const RunControl& control) override {
    const auto startOf = [&](uint32_t i) -> const ConeStart& { return starts[i]; };
    const auto write = [&](ConeChunk& chunk, std::span<const DeviceCone> cones) {
      return writeStarts(chunk, cones, startOf);
    };
    const auto sorted = [&] {
      const std::vector<uint32_t> order = spatialOrder(starts);
      UnsetVector<DeviceCone> cones(order.size());
      forEachInParallel(order.size(), [&](uint32_t i) {
        cones[i] = {isNearBox(starts[order[i]].origin) ? 0 : kNoFace, order[i]};
      });
      return cones;
    };
    return traceAll(starts.size(), sorted, write, startOf, results, control);
  }

  std::unique_ptr<DeviceHits> makeDeviceHits() const override {
    return std::make_unique<VulkanHits>(kernel_.device(), kernel_.rayCount());
  }

  double encodeSeconds() const override { return encodeSeconds_; }

 private:
  /// sorted(): all cones, in the order of the device. write(chunk, cones): writes the input of these cones and returns
  /// its kind. startOf(i): the start of cone i.
  template <typename Sorted, typename Write, typename StartOf>
  TraceStatistics traceAll(size_t coneCount, const Sorted& sorted, const Write& write, const StartOf& startOf,
                           const ConeResults& results, const RunControl& control) {
    checkSizes(results, coneCount, kernel_.rayCount());
    auto* const kept = static_cast<VulkanHits*>(results.onDevice);
    ASDFVK_CHECK((results.hits.empty() && kept == nullptr) || kernel_.writesHits());
    const uint64_t rayCount = coneCount * cone_.directions.size();
    if (scene_.bvh.nodes.empty()) {
      std::fill(results.values.begin(), results.values.end(), kNoValue);
      std::fill(results.hits.begin(), results.hits.end(), kMiss);
      ASDFVK_CHECK(kept == nullptr || coneCount == 0);
      return {rayCount, 0};
    }
    UnsetVector<DeviceCone> cones = sorted();
    std::vector<uint32_t> redone;
    const auto fits = [](const DeviceCone& cone) { return cone.seed != kNoFace; };
    if (countInParallel(coneCount, [&](uint32_t i) { return fits(cones[i]); }) < coneCount) {
      const auto firstUnfit = std::stable_partition(cones.begin(), cones.end(), fits);
      std::transform(firstUnfit, cones.end(), std::back_inserter(redone),
                     [](const DeviceCone& cone) { return cone.index; });
    }
    const size_t firstKept = kept == nullptr ? 0 : kept->coneCount();
    if (kept != nullptr) kept->add(cones);
    cones.resize(coneCount - redone.size());
    const double deviceShare = static_cast<double>(cones.size()) / static_cast<double>(std::max<size_t>(1, coneCount));
    traceOnDevice(cones, write, results, firstKept, redone, control.part(0, deviceShare));
    redo(redone, startOf, results, firstKept, control.part(deviceShare, 1));
    return {rayCount, redone.size()};
  }

  /// firstKept: the index of the first cone in results.onDevice.
  template <typename Write>
  void traceOnDevice(std::span<const DeviceCone> cones, const Write& write, const ConeResults& results,
                     size_t firstKept, std::vector<uint32_t>& redone, const RunControl& control) {
    const auto* const kept = static_cast<const VulkanHits*>(results.onDevice);
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
      const ConeChunk::Input input = write(*chunk, cones.subspan(begin, end - begin));
      chunk->submit(pushFor(end - begin), input, {!results.hits.empty(), kept, firstKept + begin});
      return end;
    };
    const auto read = [&](size_t slot, size_t begin, size_t end) {
      readChunk(*chunks[slot], cones.subspan(begin, end - begin), results, redone);
    };
    forEachChunkInFlight<kChunksInFlight>(
        cones.size(), size, control, start, [&](size_t slot) { chunks[slot]->wait(); }, read);
  }

  template <typename StartOf>
  ConeChunk::Input writeStarts(ConeChunk& chunk, std::span<const DeviceCone> cones, const StartOf& startOf) const {
    const std::span<ConeOrigin> origins = chunk.starts();
    forEachInParallel(cones.size(), [&](uint32_t i) {
      const ConeStart& start = startOf(cones[i].index);
      origins[i] = {
          toGlsl(start.origin), start.skippedFace, toGlsl(start.frame.tangent), 0, toGlsl(start.frame.bitangent), 0};
    });
    return ConeChunk::Input::Starts;
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
  void redo(const std::vector<uint32_t>& redone, const StartOf& startOf, const ConeResults& results, size_t firstKept,
            const RunControl& control) const {
    auto* const kept = static_cast<VulkanHits*>(results.onDevice);
    const std::unique_ptr<ConeTracer> reference = makeReferenceTracer(scene_, cone_);
    const bool needsHits = !results.hits.empty() || kept != nullptr;
    const size_t blockSize = largestConeChunk(kernel_);  // Bounds the copies of starts and hits.
    const auto total = static_cast<double>(redone.size());
    for (size_t begin = 0; begin < redone.size(); begin += blockSize) {
      const std::span<const uint32_t> block =
          std::span(redone).subspan(begin, std::min(blockSize, redone.size() - begin));
      std::vector<ConeStart> starts;
      starts.reserve(block.size());
      for (const uint32_t i : block) starts.push_back(startOf(i));
      std::vector<double> values(block.size());
      std::vector<ConeHit> hits(needsHits ? block.size() * kernel_.rayCount() : 0);
      reference->traceAt(
          starts, {values, hits},
          control.part(static_cast<double>(begin) / total, static_cast<double>(begin + block.size()) / total));
      for (size_t i = 0; i < block.size(); ++i) results.values[block[i]] = values[i];
      if (!results.hits.empty())
        copyHits(
            block.size(), [&](uint32_t i) { return block[i]; }, hits, results.hits);
      if (kept != nullptr) kept->write(firstKept, block, hits);
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
