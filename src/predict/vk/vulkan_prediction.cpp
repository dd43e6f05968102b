#include "predict/vk/vulkan_prediction.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <vector>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/prefetch.h"
#include "predict/prediction_kernel.h"
#include "shared/cone_hit.h"
#include "shared/cone_layout.h"
#include "shared/prediction_layout.h"
#include "shared/specialization_ids.h"
#include "spirv/hit_points.comp.h"
#include "spirv/predict_faces.comp.h"
#include "trace/adaptive_chunks.h"
#include "trace/vk/vulkan_hits.h"
#include "vk/command_list.h"
#include "vk/shared_buffer.h"

namespace asdfvk {
namespace {

constexpr uint64_t kMaxPointByteCount = 32u << 20;
// The time of a face is proportional to the number of rays.
constexpr size_t kFirstBatchRayCount = size_t{1} << 22, kFirstBatchRayCountOnCpu = size_t{1} << 18,
                 kMaxBatchRayCount = size_t{1} << 23;
constexpr size_t kBatchesInFlight = 2;
constexpr size_t kMaxBatchFaceCount = size_t{1} << 18;
// Every Vulkan device supports workgroups of 128 lanes.
constexpr uint32_t kMinPointLaneCount = 32, kMaxPointLaneCount = 128;
constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

glsl::vec3 toGlsl(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

uint32_t divideUp(size_t dividend, uint32_t divisor) {
  return static_cast<uint32_t>((dividend + divisor - 1) / divisor);
}

VkBool32 isCgal(Definition definition) { return definition == Definition::Cgal ? VK_TRUE : VK_FALSE; }

/// Upper bound of the loop iterations of a lane of predict_faces.comp.
constexpr uint64_t maxIterationCount(uint64_t rayCount) {
  const uint32_t passCount = 3 + kMedianPassCount + kSpreadPassCount;
  return passCount * kMaxContributingSeedCount * (rayCount + rayCount / 64 + 2);
}
static_assert(maxIterationCount(kMaxRayCount) <= kMaxLoopIterationCount / 10 * 9);  // DeviceFacts::endsLongLoops

ComputePipelineDescription describePoints(Definition definition, uint32_t rayCount) {
  const uint32_t laneCount = std::clamp(std::bit_ceil(rayCount), kMinPointLaneCount, kMaxPointLaneCount);
  return {.name = "hit_points.comp",
          .spirv = k_hit_points_comp,
          .bindings = std::vector(4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
          .pushConstantByteCount = sizeof(PointPush),
          .specializationConstants = {{kLocalSizeXId, laneCount},
                                      {kLanesPerConeId, laneCount},
                                      {kRayCountId, rayCount},
                                      {kLengthCountId, rayCount},
                                      {kIsCgalId, isCgal(definition)}}};
}

ComputePipelineDescription describeFaces(Definition definition) {
  return {.name = "predict_faces.comp",
          .spirv = k_predict_faces_comp,
          .bindings = std::vector(4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
          .pushConstantByteCount = sizeof(PredictionPush),
          .specializationConstants = {{kLocalSizeXId, VulkanPredictionKernels::kFaceLaneCount},
                                      {kIsCgalId, isCgal(definition)}}};
}

Buffer uploadFaces(const Device& device, const TraceScene& scene) {
  requireStorageRange(device, scene.geometry.areas.size() * sizeof(PredictionFace));
  return uploadItems<PredictionFace>(
      device, scene.geometry.areas.size(), kStorage, [&](size_t first, std::span<PredictionFace> faces) {
        for (auto face = static_cast<uint32_t>(first); face < first + faces.size(); ++face)
          faces[face - first] = {toGlsl(scene.originOf(face)), scene.representatives[face],
                                 toGlsl(scene.geometry.normals[face]), 0};
      });
}

class VulkanPredictor final : public DevicePredictor {
 public:
  VulkanPredictor(const VulkanPredictionKernels& kernels, const TraceScene& scene, const Cone& cone,
                  const PredictionBatchSize& batchSize)
      : kernels_(kernels),
        scene_(scene),
        cone_(cone),
        batchSize_(batchSize),
        rules_(PredictionKernel::rulesOf(cone)),
        faces_(uploadFaces(kernels.device(), scene)),
        values_(kernels.device(), std::max<uint64_t>(16, scene.geometry.areas.size() * sizeof(uint32_t)), kStorage,
                SharedBuffer::Host::Reads) {
    ASDFVK_CHECK_OP(cone.directions.size(), ==, size_t{kernels.rayCount()});
    ASDFVK_CHECK(cone.definition == kernels.definition());
    ASDFVK_CHECK_OP(batchSize.maxSeedCount, >=, size_t{kMaxContributingSeedCount});
    ASDFVK_CHECK_OP(batchSize.maxFaceCount, >, size_t{0});
  }

  void predict(const PredictionInput& input, std::span<double> values, const RunControl& control) override {
    if (input.options.neighbourCount >= kMaxContributingSeedCount)
      throw Error(ErrorCode::DeviceLimit, fmt::format("{} neighbouring seeds per face are too many; give 0 to {}",
                                                      input.options.neighbourCount, kMaxContributingSeedCount - 1));
    if (input.order.empty()) return;
    PredictionBatches batches(input);
    predictBatches(input, batches, control);
    const std::span<const uint32_t> lengths = values_.onHost<uint32_t>();
    constexpr size_t kGrain = 64;  // Few cells per task, because a cell may have many faces.
    forEachRange(input.order.size(), kGrain, [&](size_t begin, size_t end) {
      for (const uint32_t cell : input.order.subspan(begin, end - begin))
        for (const uint32_t node : input.cells[cell]) {
          const uint32_t bits = lengths[input.domain.faceOf(node)];
          const double length = bits == kNoValueBits ? kNoValue : std::bit_cast<float>(bits);
          values[node] =
              batches.isKept(cell, node) ? input.earlier.values[node] : scene_.bvh.normalization.toMeshLength(length);
        }
    });
  }

 private:
  /// Largest numbers of the batches of an input. Small meshes need less memory than the largest batch. A batch of all
  /// seeds has room for those of one more cell (PredictionBatches::next()).
  [[nodiscard]] PredictionBatchSize sizeFor(const PredictionInput& input) const {
    return {std::min(batchSize_.maxSeedCount, input.hits.seeds.size() + kMaxContributingSeedCount),
            std::min(batchSize_.maxFaceCount, input.cells.entries.size())};
  }

  /// Memory and commands for one batch.
  struct Batch {
    /// kept: the hits on the device; null: those of a batch are uploaded.
    Batch(const VulkanPredictionKernels& kernels, const PredictionBatchSize& size, const VulkanHits* kept,
          const Buffer& faces, const Buffer& values)
        : table(kernels.device(),
                kernels.rayCount() * sizeof(PredictionRay) + size.maxSeedCount * sizeof(PredictionSeed) +
                    placeByteCount(size.maxSeedCount),
                kStorage, SharedBuffer::Host::Writes),
          work(kernels.device(),
               (2 * size.maxFaceCount + kMaxContributingSeedCount * size.maxSeedCount) * sizeof(uint32_t), kStorage,
               SharedBuffer::Host::Writes),
          hits(kernels.device(), kept == nullptr ? size.maxSeedCount * kernels.rayCount() * sizeof(ConeHit) : 16,
               kStorage, SharedBuffer::Host::Writes),
          points(kernels.device(), size.maxSeedCount * (kernels.rayCount() + 1) * sizeof(PredictionPoint), kStorage,
                 MemoryKind::DeviceLocal),
          pointBindings(kernels.device(), kernels.points(),
                        std::array<Binding, 4>{faces, table.onDevice(),
                                               kept == nullptr ? hits.onDevice() : kept->buffer(), points}),
          faceBindings(kernels.device(), kernels.faces(),
                       std::array<Binding, 4>{faces, points, work.onDevice(), values}),
          commands(kernels.device()) {}

    SharedBuffer table, work;  // See PredictionSeed and PredictionPush.
    SharedBuffer hits;         // Not used if the hits are on the device.
    Buffer points;
    BindingSet pointBindings, faceBindings;
    CommandList commands;  // Destroyed first; its destructor waits.
  };

  static uint64_t placeByteCount(size_t seedCount) { return divideUp(seedCount, 4) * 4 * sizeof(uint32_t); }

  void predictBatches(const PredictionInput& input, PredictionBatches& batches, const RunControl& control) {
    const PredictionBatchSize largest = sizeFor(input);
    const auto* const kept = static_cast<const VulkanHits*>(input.hits.onDevice);
    const size_t firstRayCount = kernels_.device().facts().isCpu() ? kFirstBatchRayCountOnCpu : kFirstBatchRayCount;
    const ChunkSize size(std::max<size_t>(1, firstRayCount / kernels_.rayCount()), largest.maxFaceCount,
                         ChunkSize::kTargetSeconds / kBatchesInFlight);
    std::array<std::optional<Batch>, kBatchesInFlight> inFlight;
    const auto start = [&](size_t slot, size_t begin, size_t end) {
      std::optional<Batch>& batch = inFlight[slot];
      if (!batch) batch.emplace(kernels_, largest, kept, faces_, values_.onDevice());
      (void)batches.next({largest.maxSeedCount, end - begin});
      writeTable(input, batches.seeds(), kept, batch->table.onHost<std::byte>());
      if (kept == nullptr) writeHits(input, batches.seeds(), batch->hits.onHost<ConeHit>());
      batches.write(batch->work.onHost<uint32_t>());
      submit(input, batches, *batch);
      return begin + batches.faceCount();
    };
    forEachChunkInFlight<kBatchesInFlight>(
        batches.allFaceCount(), size, control, start, [&](size_t slot) { inFlight[slot]->commands.wait(); },
        [](size_t, size_t, size_t) {});
  }

  void writeTable(const PredictionInput& input, std::span<const uint32_t> seeds, const VulkanHits* kept,
                  std::span<std::byte> table) const {
    for (size_t i = 0; i < cone_.directions.size(); ++i) {
      const PredictionRay ray{toGlsl(cone_.directions[i]), static_cast<float>(cone_.solidAngles[i])};
      std::memcpy(&table[i * sizeof ray], &ray, sizeof ray);
    }
    const std::span<std::byte> ofSeeds = table.subspan(cone_.directions.size() * sizeof(PredictionRay)),
                               places = ofSeeds.subspan(seeds.size() * sizeof(PredictionSeed));
    constexpr size_t kPrefetchDistance = 8;  // The normals of the seeds are far from each other in memory.
    forEachInParallel(seeds.size(), [&](uint32_t i) {
      if (i + kPrefetchDistance < seeds.size())
        prefetchMemory(&scene_.geometry.normals[input.hits.seeds[seeds[i + kPrefetchDistance]]]);
      const uint32_t face = input.hits.seeds[seeds[i]], place = kept == nullptr ? i : kept->placeOf(seeds[i]);
      const PredictionSeed seed{toGlsl(seedConeFrame(scene_, cone_, face).tangent), face};
      std::memcpy(&ofSeeds[i * sizeof seed], &seed, sizeof seed);
      std::memcpy(&places[i * sizeof place], &place, sizeof place);
    });
  }

  void writeHits(const PredictionInput& input, std::span<const uint32_t> seeds, std::span<ConeHit> hits) const {
    const size_t rayCount = kernels_.rayCount();
    forEachInParallel(seeds.size(), [&](uint32_t i) {
      std::ranges::copy(input.hits.of(seeds[i]), hits.subspan(i * rayCount).begin());
    });
  }

  void submit(const PredictionInput& input, const PredictionBatches& batches, Batch& batch) {
    const auto seedCount = static_cast<uint32_t>(batches.seeds().size());
    const PointPush pointPush{static_cast<float>(cone_.falseHitCosine), static_cast<float>(cone_.outliers.deviations)};
    const PredictionPush push{static_cast<uint32_t>(batches.faceCount()),
                              kernels_.rayCount(),
                              rules_.minCosine,
                              rules_.maxNormalCosine,
                              rules_.minVersine,
                              rules_.outlierDeviations,
                              rules_.outlierSlack,
                              static_cast<float>(input.options.distanceDeviation)};
    CommandList& commands = batch.commands;
    commands.begin();
    batch.table.recordCopy(commands, kernels_.rayCount() * sizeof(PredictionRay) + seedCount * sizeof(PredictionSeed) +
                                         placeByteCount(seedCount));
    if (input.hits.onDevice == nullptr)
      batch.hits.recordCopy(commands, uint64_t{seedCount} * kernels_.rayCount() * sizeof(ConeHit));
    batch.work.recordCopy(
        commands, (2 * batches.faceCount() + kMaxContributingSeedCount * batches.cellCount()) * sizeof(uint32_t));
    commands.barrier();
    commands.dispatch(kernels_.points(), batch.pointBindings, bytesOf(pointPush), seedCount);
    commands.barrier();
    commands.dispatch(kernels_.faces(), batch.faceBindings, bytesOf(push),
                      divideUp(batches.faceCount(), VulkanPredictionKernels::kFaceLaneCount));
    commands.barrier();
    if (batches.isLast()) {
      values_.recordCopy(commands, scene_.geometry.areas.size() * sizeof(uint32_t));
      commands.barrier();
    }
    commands.submit();
  }

  const VulkanPredictionKernels& kernels_;
  TraceScene scene_;
  const Cone& cone_;
  PredictionBatchSize batchSize_;
  PredictionKernel::Rules rules_;
  Buffer faces_;         // A PredictionFace per face.
  SharedBuffer values_;  // One value per face, see predict_faces.comp.
};

}  // namespace

VulkanPredictionKernels::VulkanPredictionKernels(const Device& device, Definition definition, uint32_t rayCount)
    : device_(device),
      definition_(definition),
      rayCount_(rayCount),
      points_(device, describePoints(definition, rayCount)),
      faces_(device, describeFaces(definition)) {}

PredictionBatchSize predictionBatchSize(const VulkanPredictionKernels& kernels) {
  const DeviceFacts& facts = kernels.device().facts();
  const uint64_t seedByteCount = (kernels.rayCount() + 1) * sizeof(PredictionPoint);
  const uint64_t seedCount = std::min<uint64_t>(
      std::min(kMaxPointByteCount, facts.maxStorageBufferRange) / seedByteCount, facts.maxWorkgroupCount);
  return {std::max<size_t>(kMaxContributingSeedCount, seedCount),
          std::min(kMaxBatchFaceCount, kMaxBatchRayCount / kernels.rayCount())};
}

std::unique_ptr<DevicePredictor> makeVulkanPredictor(const VulkanPredictionKernels& kernels, const TraceScene& scene,
                                                     const Cone& cone,
                                                     const std::optional<PredictionBatchSize>& batchSize) {
  return std::make_unique<VulkanPredictor>(kernels, scene, cone, batchSize.value_or(predictionBatchSize(kernels)));
}

}  // namespace asdfvk
