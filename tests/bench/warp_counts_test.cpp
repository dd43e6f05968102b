// Steps of the subgroups of a GPU, counted and not timed: a change that makes tracing on GPUs slower fails here. If a
// change makes tracing cheaper on purpose, store the new numbers.
#include "warps/warp_counts.h"

#include <doctest/doctest.h>

#include <string>

#include "generate/shapes.h"
#include "seeds/random_permutation.h"
#include "trace/reference_tracer.h"
#include "trace/traced_mesh.h"
#include "warps/step_costs.h"

namespace asdfvk::bench {
namespace {

struct SampledMesh {
  TracedMesh traced;
  Cone cone = makeCone({});
  DeviceScene device = deviceSceneOf(traced.scene(), cone);

  explicit SampledMesh(const char* shape) : traced(generateShape(shape, 20'000).mesh) {}

  [[nodiscard]] WarpCounts count(std::span<const uint32_t> faces, const WarpSchedule& schedule,
                                 const RayEnd& atEnd = {}) const {
    return countWarps(traced.scene(), device, cone, faces, schedule, atEnd);
  }
};

DeviceFacts nvidia() {
  DeviceFacts facts;
  facts.kind = DeviceKind::Discrete;
  facts.vendor = DeviceVendor::Nvidia;
  facts.subgroupSize = 32;
  facts.maxWorkgroupInvocations = facts.maxWorkgroupSize = 1024;
  return facts;
}

WarpSchedule defaultSchedule(const DeviceFacts& device) {
  return scheduleFor(device, defaultTraceChoice(device).kernel, 30);
}

}  // namespace

TEST_CASE("the steps of subgroups by the default of GPUs are within 1 % of the stored ones") {
  struct Steps {
    double nodes, triangles;
  };
  const struct {
    const char* shape;
    Steps all, tenth;
  } rows[]{{"animal", {0.5073, 0.2947}, {0.5673, 0.3352}},
           {"hand", {0.4965, 0.2992}, {0.5709, 0.3446}},
           {"tree", {0.5502, 0.3859}, {0.6204, 0.4319}}};
  for (const auto& row : rows) {
    CAPTURE(std::string(row.shape));
    const SampledMesh mesh(row.shape);
    const auto check = [&](std::span<const uint32_t> seedFaces, uint32_t runCount, const Steps& stored) {
      const WarpCounts counts =
          mesh.count(sampleCones(mesh.traced.scene(), seedFaces, runCount), defaultSchedule(nvidia()));
      const Steps now{counts.perRay(counts.nodeStepCount), counts.perRay(counts.triangleStepCount)};
      INFO("{", now.nodes, ", ", now.triangles, "}");
      CHECK(now.nodes == doctest::Approx(stored.nodes).epsilon(0.01));
      CHECK(now.triangles == doctest::Approx(stored.triangles).epsilon(0.01));
      CHECK(counts.greatestStackSize() <= mesh.device.bvh.depth);
    };
    const std::vector<uint32_t> all = mesh.traced.seedFaces();
    check(all, 8, row.all);
    check(randomPermutationSeeds(all, all.size() / 10, 1), 8, row.tenth);
  }
}

TEST_CASE("simulated lanes find the hits of the reference, by every schedule") {
  const SampledMesh mesh("animal");
  const std::vector<uint32_t> faces = sampleCones(mesh.traced.scene(), mesh.traced.seedFaces(), 2);
  const size_t rayCount = mesh.cone.directions.size();
  std::vector<double> values(faces.size());
  std::vector<ConeHit> hits(faces.size() * rayCount);
  makeReferenceTracer(mesh.traced.scene(), mesh.cone)->trace(faces, {values, hits}, {});
  for (const TraceKernel kernel : {TraceKernel::Ray, TraceKernel::Seed}) {
    for (const bool postpones : {false, true}) {
      for (const uint32_t subgroupSize : {8u, 32u, 64u}) {
        CAPTURE(static_cast<int>(kernel));
        CAPTURE(postpones);
        CAPTURE(subgroupSize);
        DeviceFacts device = nvidia();
        device.subgroupSize = subgroupSize;
        WarpSchedule schedule = scheduleFor(device, kernel, 30);
        schedule.postponesTriangles = postpones;
        uint64_t differingCount = 0;
        const WarpCounts counts = mesh.count(faces, schedule, [&](uint32_t cone, uint32_t ray, const RayLane& lane) {
          const uint32_t primitive = lane.hitPrimitive();
          const uint32_t face = primitive == kNoPrimitive ? kNoFace : mesh.device.triangles[primitive].faceIndex;
          differingCount += face != hits[cone * rayCount + ray].face;
        });
        CHECK(counts.rayCount == hits.size());
        CHECK(differingCount <= hits.size() / 500);
        CHECK(counts.nodeCount <= counts.nodeStepCount * subgroupSize);
        CHECK(counts.triangleCount <= counts.triangleStepCount * subgroupSize * (postpones ? 2 : 1));
      }
    }
  }
}

TEST_CASE("one lane per subgroup makes as many steps as it visits nodes") {
  const SampledMesh mesh("animal");
  const std::vector<uint32_t> faces = sampleCones(mesh.traced.scene(), mesh.traced.seedFaces(), 1);
  const WarpSchedule schedule{{.lanesPerCone = 1, .conesPerWorkgroup = 1}, false, 1};
  const WarpCounts counts = mesh.count(faces, schedule);
  CHECK(counts.nodeStepCount == counts.nodeCount);
  CHECK(counts.triangleStepCount == counts.triangleCount);
  CHECK(warpInstructionsPerRay(counts, schedule, {1, 0}) == counts.perRay(counts.nodeCount));
  CHECK(warpInstructionsPerRay(counts, {schedule.shape, false, 64}, {0, 1}) == 2 * counts.perRay(counts.triangleCount));
}

}  // namespace asdfvk::bench
