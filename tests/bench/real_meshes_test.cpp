// Instructions of the subgroups of a GPU on large meshes, by the default of GPUs.
#include <doctest/doctest.h>

#include <span>
#include <vector>

#include "asdf_vk/files.h"
#include "generate/shapes.h"
#include "seeds/random_permutation.h"
#include "support/computation.h"
#include "support/real_meshes.h"
#include "warps/step_costs.h"

namespace asdfvk::bench {
namespace {

double instructionsPerRay(const TraceableMesh& mesh, std::span<const uint32_t> seedFaces) {
  DeviceFacts gpu;
  gpu.kind = DeviceKind::Discrete;
  gpu.vendor = DeviceVendor::Nvidia;
  gpu.subgroupSize = 32;
  gpu.maxWorkgroupInvocations = gpu.maxWorkgroupSize = 1024;
  const TraceScene scene = mesh.scene();
  const Cone cone = makeCone({});
  const WarpSchedule schedule = scheduleFor(gpu, defaultTraceChoice(gpu).kernel, 30);
  const WarpCounts counts =
      countWarps(scene, deviceSceneOf(scene, cone), cone, sampleCones(scene, seedFaces, 128), schedule);
  return warpInstructionsPerRay(counts, schedule, stepCosts(schedule));
}

}  // namespace

TEST_CASE("a ray takes at most 270 instructions with all of 1.5 million faces as seeds, and 300 with a tenth") {
  if (!test::realMeshFolder()) return;  // Not for the quick tests.
  const TraceableMesh animal(generateShape("animal", 1'500'000).mesh);
  const std::vector<uint32_t>& faces = animal.prepared.traceableFaces;
  CHECK(instructionsPerRay(animal, faces) <= 270);
  CHECK(instructionsPerRay(animal, randomPermutationSeeds(faces, faces.size() / 10, 1)) <= 300);
}

TEST_CASE("a ray takes at most 320 instructions on the horse") {
  const auto folder = test::realMeshFolder();
  if (!folder) return;
  const TraceableMesh horse(readMesh(*folder / "models/horse.ply"));
  CHECK(instructionsPerRay(horse, horse.prepared.traceableFaces) <= 320);
}

}  // namespace asdfvk::bench
