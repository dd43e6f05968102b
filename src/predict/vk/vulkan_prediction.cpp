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
#include "core/stopwatch.h"
#include "predict/prediction_kernel.h"
#include "shared/cone_hit.h"
#include "shared/cone_layout.h"
#include "shared/prediction_layout.h"
#include "shared/specialization_ids.h"
#include "spirv/hit_points.comp.h"
#include "spirv/predict_faces.comp.h"
#include "trace/adaptive_chunks.h"
#include "vk/command_list.h"
#include "vk/shared_buffer.h"

namespace asdfvk {
namespace {

constexpr uint64_t kMaxPointByteCount = 32u << 20;
// The time of a face is proportional to the number of rays.
constexpr size_t kFirstBatchRayCount = size_t{1} << 22, kFirstBatchRayCountOnCpu = size_t{1} << 18,
                 kMaxBatchRayCount = size_t{1} << 23;
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
                SharedBuffer::Host::Reads),
        commands_(kernels.device()) {
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
  /// Memory for one batch.
  struct Memory {
    Memory(const VulkanPredictionKernels& kernels, const Buffer& faces, const Buffer& values, size_t seeds,
           size_t items)
        : seedCount(seeds),
          faceCount(items),
          table(kernels.device(), kernels.rayCount() * sizeof(PredictionRay) + seeds * sizeof(PredictionSeed), kStorage,
                SharedBuffer::Host::Writes),
          work(kernels.device(), (2 * items + kMaxContributingSeedCount * seeds) * sizeof(uint32_t), kStorage,
               SharedBuffer::Host::Writes),
          hits(kernels.device(), seeds * kernels.rayCount() * sizeof(ConeHit), kStorage, SharedBuffer::Host::Writes),
          points(kernels.device(), seeds * (kernels.rayCount() + 1) * sizeof(PredictionPoint), kStorage,
                 MemoryKind::DeviceLocal),
          pointBindings(kernels.device(), kernels.points(),
                        std::array<Binding, 4>{faces, table.onDevice(), hits.onDevice(), points}),
          faceBindings(kernels.device(), kernels.faces(),
                       std::array<Binding, 4>{faces, points, work.onDevice(), values}) {}

    size_t seedCount, faceCount;
    SharedBuffer table, work, hits;
    Buffer points;
    BindingSet pointBindings, faceBindings;
  };

  /// Allocates the memory of a batch. Small meshes need less than the largest batch.
  void reserve(const PredictionInput& input) {
    const size_t seedCount =
        std::min(batchSize_.maxSeedCount, std::max<size_t>(kMaxContributingSeedCount, input.hits.seeds.size()));
    const size_t faceCount = std::min(batchSize_.maxFaceCount, input.cells.entries.size());
    if (memory_ && memory_->seedCount >= seedCount && memory_->faceCount >= faceCount) return;
    memory_.reset();
    memory_.emplace(kernels_, faces_, values_.onDevice(), seedCount, faceCount);
    const std::span<PredictionRay> rays = memory_->table.onHost<PredictionRay>();
    for (size_t i = 0; i < cone_.directions.size(); ++i)
      rays[i] = {toGlsl(cone_.directions[i]), static_cast<float>(cone_.solidAngles[i])};
  }

  void predictBatches(const PredictionInput& input, PredictionBatches& batches, const RunControl& control) {
    reserve(input);
    const bool isCpu = kernels_.device().facts().isCpu();
    const size_t firstRayCount = isCpu ? kFirstBatchRayCountOnCpu : kFirstBatchRayCount;
    ChunkSize size(std::max<size_t>(1, firstRayCount / kernels_.rayCount()), memory_->faceCount);
    while (batches.next({memory_->seedCount, size.current()})) {
      control.checkpoint(batches.progress());
      writeSeeds(input, batches.seeds());
      batches.write(memory_->work.onHost<uint32_t>());
      const Stopwatch stopwatch;
      dispatch(input, batches);
      size.adapt(batches.faceCount(), stopwatch.seconds());
    }
    control.checkpoint(1);
  }

  void writeSeeds(const PredictionInput& input, std::span<const uint32_t> seeds) {
    const size_t rayCount = kernels_.rayCount();
    const std::span<std::byte> table = memory_->table.onHost<std::byte>().subspan(rayCount * sizeof(PredictionRay));
    const std::span<ConeHit> hits = memory_->hits.onHost<ConeHit>();
    constexpr size_t kPrefetchDistance = 8;  // The normals of the seeds are far from each other in memory.
    forEachInParallel(seeds.size(), [&](uint32_t i) {
      if (i + kPrefetchDistance < seeds.size())
        prefetchMemory(&scene_.geometry.normals[input.hits.seeds[seeds[i + kPrefetchDistance]]]);
      const uint32_t face = input.hits.seeds[seeds[i]];
      const PredictionSeed seed{toGlsl(seedConeFrame(scene_, cone_, face).tangent), face};
      std::memcpy(&table[i * sizeof seed], &seed, sizeof seed);
      std::ranges::copy(input.hits.of(seeds[i]), hits.subspan(i * rayCount).begin());
    });
  }

  void dispatch(const PredictionInput& input, const PredictionBatches& batch) {
    const auto seedCount = static_cast<uint32_t>(batch.seeds().size());
    const PointPush pointPush{static_cast<float>(cone_.falseHitCosine), static_cast<float>(cone_.outliers.deviations)};
    const PredictionPush push{static_cast<uint32_t>(batch.faceCount()),
                              kernels_.rayCount(),
                              rules_.minCosine,
                              rules_.maxNormalCosine,
                              rules_.minVersine,
                              rules_.outlierDeviations,
                              rules_.outlierSlack,
                              static_cast<float>(input.options.distanceDeviation)};
    commands_.begin();
    memory_->table.recordCopy(commands_,
                              kernels_.rayCount() * sizeof(PredictionRay) + seedCount * sizeof(PredictionSeed));
    memory_->hits.recordCopy(commands_, uint64_t{seedCount} * kernels_.rayCount() * sizeof(ConeHit));
    memory_->work.recordCopy(
        commands_, (2 * batch.faceCount() + kMaxContributingSeedCount * batch.cellCount()) * sizeof(uint32_t));
    commands_.barrier();
    commands_.dispatch(kernels_.points(), memory_->pointBindings, bytesOf(pointPush), seedCount);
    commands_.barrier();
    commands_.dispatch(kernels_.faces(), memory_->faceBindings, bytesOf(push),
                       divideUp(batch.faceCount(), VulkanPredictionKernels::kFaceLaneCount));
    commands_.barrier();
    if (batch.isLast()) {
      values_.recordCopy(commands_, scene_.geometry.areas.size() * sizeof(uint32_t));
      commands_.barrier();
    }
    commands_.submitAndWait();
  }

  const VulkanPredictionKernels& kernels_;
  TraceScene scene_;
  const Cone& cone_;
  PredictionBatchSize batchSize_;
  PredictionKernel::Rules rules_;
  Buffer faces_;         // A PredictionFace per face.
  SharedBuffer values_;  // One value per face, see predict_faces.comp.
  std::optional<Memory> memory_;
  CommandList commands_;
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
