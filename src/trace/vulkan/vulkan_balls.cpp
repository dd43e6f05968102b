#include "trace/vulkan/vulkan_balls.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "shared/ball_layout.h"
#include "shared/cone_hit.h"
#include "trace/chunks.h"
#include "trace/cone_tracer.h"
#include "trace/seed_order.h"
#include "vk/command_list.h"

namespace asdfvk {
namespace {

constexpr uint64_t kFirstChunkInvocationCount = 4096;
constexpr uint64_t kMaxChunk = 1u << 17;  // 4 MiB of 32 bytes each.

uint64_t largestChunk(const Device& device) {
  return std::min({kMaxChunk, uint64_t{device.facts().maxWorkgroupCount} * VulkanConeKernel::kBallLaneCount,
                   device.facts().maxStorageBufferRange / sizeof(BallStart)});
}

class VulkanBallShrinker final : public BallShrinker {
 public:
  VulkanBallShrinker(const VulkanConeKernel& kernel, const ConeBuffers& buffers, const TraceScene& scene,
                     const OpposingWalls& walls)
      : pipeline_(*kernel.balls()),
        scene_(scene),
        walls_(walls),
        order_(scene),
        largestChunk_(largestChunk(kernel.device())),
        childNormalStart_(buffers.childNormalStart),
        starts_(kernel.device(), largestChunk_ * sizeof(BallStart), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                MemoryKind::HostVisible),
        results_(kernel.device(), largestChunk_ * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                 MemoryKind::HostVisible),
        bindings_(kernel.device(), pipeline_, buffers.ballBindings(kernel, starts_, results_)),
        commands_(kernel.device()) {}

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
    forEachChunk(order.size(), ChunkSize(kFirstChunkInvocationCount, largestChunk_), control,
                 [&](size_t begin, size_t end) {
                   const std::span<const uint32_t> chunk = std::span(order).subspan(begin, end - begin);
                   run(balls, chunk);
                   read(balls, chunk, redone);
                 });
    redo(balls, redone, control);
    return redone.size();
  }

 private:
  void run(std::span<const InscribedBall> balls, std::span<const uint32_t> chunk) {
    const std::span<BallStart> starts = starts_.mappedAs<BallStart>();
    tbb::parallel_for(size_t{0}, chunk.size(), [&](size_t i) {
      const InscribedBall& ball = balls[chunk[i]];
      starts[i] = {toGlsl(scene_.originOf(ball.face)), scene_.representatives[ball.face],
                   toGlsl(-scene_.geometry.normals[ball.face]), static_cast<float>(ball.diameter)};
    });
    const BallPush push{static_cast<uint32_t>(chunk.size()), static_cast<float>(walls_.cosine), childNormalStart_};
    commands_.begin();
    commands_.dispatch(pipeline_, bindings_, bytesOf(push),
                       (push.ballCount + VulkanConeKernel::kBallLaneCount - 1) / VulkanConeKernel::kBallLaneCount);
    commands_.barrier();
    commands_.submitAndWait();
  }

  void read(std::span<InscribedBall> balls, std::span<const uint32_t> chunk, std::vector<uint32_t>& redone) const {
    const std::span<const uint32_t> results = results_.mappedAs<uint32_t>();
    tbb::parallel_for(size_t{0}, chunk.size(), [&](size_t i) {
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

  const ComputePipeline& pipeline_;
  TraceScene scene_;
  OpposingWalls walls_;
  SeedOrder order_;
  uint64_t largestChunk_;
  uint32_t childNormalStart_;
  Buffer starts_, results_;  // Mapped: BallStart, and a uint32_t per ball.
  BindingSet bindings_;
  CommandList commands_;
};

}  // namespace

std::unique_ptr<BallShrinker> makeVulkanBallShrinker(const VulkanConeKernel& kernel, const ConeBuffers& buffers,
                                                     const TraceScene& scene, const OpposingWalls& walls) {
  return std::make_unique<VulkanBallShrinker>(kernel, buffers, scene, walls);
}

}  // namespace asdfvk
