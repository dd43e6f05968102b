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

  uint64_t shrink(std::span<InscribedBall> balls, const RunControl& control) override {
    if (scene_.bvh.nodes.empty()) return 0;
    std::vector<uint32_t> faces(balls.size());
    std::transform(balls.begin(), balls.end(), faces.begin(), [](const InscribedBall& ball) { return ball.face; });
    std::vector<uint32_t> order = order_.of(faces);
    const auto firstSmall = std::stable_partition(order.begin(), order.end(), [&](uint32_t i) {
      return balls[i].diameter >= kMinFloatDiameter && !isTooSmallForFloat(scene_, balls[i].face);
    });
    std::vector<uint32_t> redone(firstSmall, order.end());  // Indices into balls.
    order.erase(firstSmall, order.end());
    const uint64_t largest = std::clamp<uint64_t>(order.size(), 1, largestChunk(kernel_.device()));
    BallChunk memory(kernel_, buffers_, largest);
    forEachChunk(order.size(), ChunkSize(kFirstChunkInvocationCount, largest), control, [&](size_t begin, size_t end) {
      const std::span<const uint32_t> chunk = std::span(order).subspan(begin, end - begin);
      run(balls, chunk, memory);
      read(balls, chunk, memory.results->mappedAs<uint32_t>(), redone);
    });
    redo(balls, redone, control);
    return redone.size();
  }

 private:
  void run(std::span<const InscribedBall> balls, std::span<const uint32_t> chunk, BallChunk& memory) const {
    const std::span<BallStart> starts = memory.starts->mappedAs<BallStart>();
    forEachInParallel(chunk.size(), [&](size_t i) {
      const InscribedBall& ball = balls[chunk[i]];
      starts[i] = {toGlsl(scene_.originOf(ball.face)), scene_.representatives[ball.face],
                   toGlsl(-scene_.geometry.normals[ball.face]), static_cast<float>(ball.diameter)};
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

  void read(std::span<InscribedBall> balls, std::span<const uint32_t> chunk, std::span<const uint32_t> results,
            std::vector<uint32_t>& redone) const {
    forEachInParallel(chunk.size(), [&](size_t i) {
      if (results[i] == kNoFace || results[i] == kUnfinishedBall) return;
      InscribedBall& ball = balls[chunk[i]];
      const double diameter = touchingDiameter(scene_, ball.face, results[i], ball.diameter);
      if (diameter < ball.diameter) ball = {ball.face, results[i], diameter};
    });
    for (size_t i = 0; i < chunk.size(); ++i)
      if (results[i] == kUnfinishedBall || balls[chunk[i]].diameter < kMinFloatDiameter) redone.push_back(chunk[i]);
  }

  void redo(std::span<InscribedBall> balls, std::span<const uint32_t> indices, const RunControl& control) const {
    if (indices.empty()) return;
    std::vector<InscribedBall> copies;
    for (const uint32_t i : indices) copies.push_back(balls[i]);
    makeReferenceBallShrinker(scene_, walls_)->shrink(copies, control.withoutProgress());
    for (size_t i = 0; i < indices.size(); ++i) balls[indices[i]] = copies[i];
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
