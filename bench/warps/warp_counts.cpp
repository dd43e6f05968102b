#include "warps/warp_counts.h"

#include <algorithm>

#include "trace/cone_start.h"
#include "trace/vk/device_seeds.h"

namespace asdfvk::bench {
namespace {

/// The lanes of a subgroup that have rays.
class Warp {
 public:
  Warp(const DeviceScene& scene, const WarpSchedule& schedule, WarpCounts& counts)
      : scene_(scene), postpones_(schedule.postponesTriangles), counts_(counts) {}

  void trace(std::span<RayLane> lanes) {
    while (std::ranges::any_of(lanes, &RayLane::hasNodes)) {
      visitNodes(lanes);
      testTriangles(lanes);
    }
  }

 private:
  /// The inner loop over nodes. A lane leaves it if it has no node left. Postponed triangles: all lanes leave it as
  /// soon as the queue of a lane is full. Otherwise, a lane with triangles leaves it.
  void visitNodes(std::span<RayLane> lanes) {
    const auto isInLoop = [&](const RayLane& lane) { return lane.hasNodes() && (postpones_ || !lane.hasTriangles()); };
    while (std::ranges::any_of(lanes, isInLoop) && !(postpones_ && std::ranges::any_of(lanes, &RayLane::isQueueFull))) {
      for (RayLane& lane : lanes)
        if (isInLoop(lane)) lane.visitNode(scene_);
      ++counts_.nodeStepCount;
    }
  }

  void testTriangles(std::span<RayLane> lanes) {
    while (std::ranges::any_of(lanes, &RayLane::hasTriangles)) {
      for (RayLane& lane : lanes)
        if (lane.hasTriangles()) lane.testTriangles(scene_, postpones_ ? 2 : 1);
      ++counts_.triangleStepCount;
    }
  }

  const DeviceScene& scene_;
  bool postpones_;
  WarpCounts& counts_;
};

}  // namespace

WarpSchedule scheduleFor(const DeviceFacts& device, TraceKernel kernel, uint32_t rayCount) {
  const VulkanWalkShape walk = walkShapeFor(device);
  return {workgroupShapeFor(device, rayCount, kernel), walk.postponesTriangles,
          walk.subgroupSize > 0 ? walk.subgroupSize : device.subgroupSize};
}

uint32_t WarpCounts::greatestStackSize() const {
  uint32_t size = kMaxBvhDepth;
  while (size > 0 && stackSizes[size] == 0) --size;
  return size;
}

double warpInstructionsPerRay(const WarpCounts& counts, const WarpSchedule& schedule, const StepCosts& costs) {
  const double instructions = costs.node * static_cast<double>(counts.nodeStepCount) +
                              costs.triangles * static_cast<double>(counts.triangleStepCount);
  return instructions * std::max(1u, schedule.subgroupSize / 32) / static_cast<double>(counts.rayCount);
}

std::vector<uint32_t> sampleCones(const TraceScene& scene, std::span<const uint32_t> seedFaces, uint32_t runCount) {
  const WideBvh wide = encodeWideBvh(scene.bvh);
  const UnsetVector<DeviceCone> ordered = DeviceSeeds(scene, wide.primitiveFaces).inDeviceOrder(seedFaces);
  const size_t wholeRunCount = ordered.size() / kConesPerRun;
  std::vector<uint32_t> faces;
  for (size_t i = 0; i < std::min<size_t>(runCount, wholeRunCount); ++i) {
    const size_t run = i * wholeRunCount / std::min<size_t>(runCount, wholeRunCount);
    for (size_t cone = 0; cone < kConesPerRun; ++cone)
      faces.push_back(seedFaces[ordered[run * kConesPerRun + cone].index]);
  }
  return faces;
}

WarpCounts countWarps(const TraceScene& scene, const DeviceScene& device, const Cone& cone,
                      std::span<const uint32_t> faces, const WarpSchedule& schedule, const RayEnd& atEnd) {
  const auto rayCount = static_cast<uint32_t>(cone.directions.size());
  const uint32_t lanesPerCone = schedule.shape.lanesPerCone, conesPerGroup = schedule.shape.conesPerWorkgroup;
  std::vector<ConeStart> starts;
  for (const uint32_t face : faces) starts.push_back(coneStartOfFace(scene, cone, face));
  WarpCounts counts;
  Warp warp(device, schedule, counts);
  struct Place {
    uint32_t cone, ray;
  };
  std::vector<RayLane> lanes(schedule.subgroupSize);
  std::vector<Place> places(schedule.subgroupSize);
  const auto traceSubgroup = [&](uint32_t firstCone, uint32_t firstRay, uint32_t firstLane) {
    uint32_t count = 0;
    for (uint32_t lane = firstLane; lane < firstLane + schedule.subgroupSize; ++lane) {
      const Place place{firstCone + lane / lanesPerCone, firstRay + lane % lanesPerCone};
      if (lane >= lanesPerCone * conesPerGroup || place.cone >= faces.size() || place.ray >= rayCount) continue;
      const ConeStart& start = starts[place.cone];
      lanes[count].start(
          {Vec3f(start.origin), Vec3f(start.frame.toWorld(cone.directions[place.ray])), start.skippedFace});
      places[count++] = place;
    }
    warp.trace(std::span(lanes).first(count));
    counts.rayCount += count;
    for (uint32_t i = 0; i < count; ++i) {
      counts.nodeCount += lanes[i].nodeCount();
      counts.triangleCount += lanes[i].triangleCount();
      ++counts.stackSizes[lanes[i].greatestStackSize()];
      if (atEnd) atEnd(places[i].cone, places[i].ray, lanes[i]);
    }
  };
  for (uint32_t firstCone = 0; firstCone < faces.size(); firstCone += conesPerGroup)
    for (uint32_t firstRay = 0; firstRay < rayCount; firstRay += lanesPerCone)
      for (uint32_t lane = 0; lane < lanesPerCone * conesPerGroup; lane += schedule.subgroupSize)
        traceSubgroup(firstCone, firstRay, lane);
  return counts;
}

}  // namespace asdfvk::bench
