#include "trace/vulkan/vulkan_balls.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"
#include "shared/ball_layout.h"
#include "shared/cone_hit.h"
#include "trace/chunks.h"
#include "trace/cone_tracer.h"
#include "trace/seed_order.h"
#include "vk/buffer_pool.h"
#include "vk/command_list.h"

namespace asdfvk {
namespace {

constexpr uint64_t kFirstChunkInvocationCount = 4096;
// Part of the progress of the kernel; the reference shrinks the rest.
constexpr double kKernelProgress = 0.3;
// In normalised units: float32 resolves no larger balls.
constexpr double kMaxFloatDiameter = 8;
constexpr uint64_t kMaxChunk = 1u << 17;  // 4 MiB of 32 bytes each.

uint64_t largestChunk(const Device& device) {
  return std::min({kMaxChunk, uint64_t{device.facts().maxWorkgroupCount} * VulkanConeKernel::kBallLaneCount,
                   device.facts().maxStorageBufferRange / sizeof(BallStart)});
}

constexpr VkBufferUsageFlags kBallUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

/// Memory and commands for one submission of balls.
struct BallChunk {
  BallChunk(const VulkanConeKernel& kernel, const ConeBuffers& buffers, uint64_t capacity)
      : starts(kernel.device(), capacity * sizeof(BallStart), kBallUsage, MemoryKind::HostVisible),
        results(kernel.device(), capacity * sizeof(uint32_t), kBallUsage, MemoryKind::HostVisible),
        bindings(kernel.device(), *kernel.balls(), buffers.ballBindings(*starts, *results)),
        commands(kernel.device()) {}

  PooledBuffer starts, results;  // Mapped: BallStart, and a uint32_t per ball.
  BindingSet bindings;
  CommandList commands;
};

class VulkanBallShrinker final : public BallShrinker {
 public:
  VulkanBallShrinker(const VulkanConeKernel& kernel, const ConeBuffers& buffers, const TraceScene& scene,
                     const OpposingWalls& walls)
      : kernel_(kernel), buffers_(buffers), scene_(scene), walls_(walls), order_(scene) {}

  uint64_t shrink(std::span<FaceBalls> faces, const RunControl& control) override {
    if (scene_.bvh.nodes.empty()) return 0;
    std::vector<uint32_t> indices(faces.size());
    std::transform(faces.begin(), faces.end(), indices.begin(), [](const FaceBalls& balls) { return balls.face; });
    std::vector<uint32_t> order = order_.of(indices);
    const auto firstSmall = std::stable_partition(order.begin(), order.end(), [&](uint32_t i) {
      return faces[i].atBarycentre.ball.diameter >= kMinFloatDiameter && !isTooSmallForFloat(scene_, faces[i].face);
    });
    auto redoneCount = static_cast<uint64_t>(order.end() - firstSmall);
    order.erase(firstSmall, order.end());
    const uint64_t largest = std::clamp<uint64_t>(order.size(), 1, largestChunk(kernel_.device()));
    BallChunk memory(kernel_, buffers_, largest);
    forEachChunk(order.size(), ChunkSize(kFirstChunkInvocationCount, largest), control.part(0, kKernelProgress),
                 [&](size_t begin, size_t end) {
                   const std::span<const uint32_t> chunk = std::span(order).subspan(begin, end - begin);
                   run(faces, chunk, memory);
                   redoneCount += read(faces, chunk, memory.results->mappedAs<uint32_t>());
                 });
    // The balls of the kernel are where these begin.
    (void)makeReferenceBallShrinker(scene_, walls_)->shrink(faces, control.part(kKernelProgress, 1));
    return redoneCount;
  }

 private:
  void run(std::span<const FaceBalls> faces, std::span<const uint32_t> chunk, BallChunk& memory) const {
    const std::span<BallStart> starts = memory.starts->mappedAs<BallStart>();
    forEachInParallel(chunk.size(), [&](size_t i) {
      const FaceBalls& balls = faces[chunk[i]];
      starts[i] = {toGlsl(scene_.originOf(balls.face)), scene_.representatives[balls.face],
                   toGlsl(-scene_.geometry.normals[balls.face]),
                   static_cast<float>(std::min(balls.atBarycentre.ball.diameter, kMaxFloatDiameter))};
    });
    const BallPush push{static_cast<uint32_t>(chunk.size()), static_cast<float>(walls_.cosine),
                        buffers_.childNormalStart()};
    memory.commands.begin();
    memory.commands.dispatch(
        *kernel_.balls(), memory.bindings, bytesOf(push),
        (push.ballCount + VulkanConeKernel::kBallLaneCount - 1) / VulkanConeKernel::kBallLaneCount);
    memory.commands.barrier();
    memory.commands.submitAndWait();
  }

  /// Returns the number of balls that the reference decides: not finished, or too small for float32.
  uint64_t read(std::span<FaceBalls> faces, std::span<const uint32_t> chunk, std::span<const uint32_t> results) const {
    forEachInParallel(chunk.size(), [&](size_t i) {
      if (results[i] == kNoFace || results[i] == kUnfinishedBall) return;
      FaceBalls& balls = faces[chunk[i]];
      const TouchingBall ball =
          leastTouchingBall(scene_.originOf(balls.face), scene_.geometry.normals[balls.face],
                            triangleOf(scene_, results[i]), kMinWallDepth, balls.atBarycentre.ball.diameter);
      if (ball.diameter < balls.atBarycentre.ball.diameter) balls.atBarycentre = {ball, results[i]};
    });
    uint64_t redoneCount = 0;
    for (size_t i = 0; i < chunk.size(); ++i) {
      const bool isTooSmall = faces[chunk[i]].atBarycentre.ball.diameter < kMinFloatDiameter;
      redoneCount += results[i] == kUnfinishedBall || isTooSmall ? 1 : 0;
    }
    return redoneCount;
  }

  const VulkanConeKernel& kernel_;
  const ConeBuffers& buffers_;
  TraceScene scene_;
  OpposingWalls walls_;
  SeedOrder order_;
};

}  // namespace

std::unique_ptr<BallShrinker> makeVulkanBallShrinker(const VulkanConeKernel& kernel, const ConeBuffers& buffers,
                                                     const TraceScene& scene, const OpposingWalls& walls) {
  return std::make_unique<VulkanBallShrinker>(kernel, buffers, scene, walls);
}

}  // namespace asdfvk
