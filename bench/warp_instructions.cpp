// Simulates the subgroups of a GPU on the hierarchy of a device. Prints the steps and instructions of subgroups per ray
// for each schedule of the kernels `ray` and `seed`: at once and postponed, with 32 and 64 lanes. Needs no GPU.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "seeds/random_permutation.h"
#include "support/computation.h"
#include "support/program.h"
#include "warps/step_costs.h"
#include "warps/warp_counts.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::vector<std::string> meshes, seeds{"all", "10%"};
  uint32_t runs = 256;
};

DeviceFacts gpuWith(uint32_t subgroupSize) {
  DeviceFacts facts;
  facts.kind = DeviceKind::Discrete;
  facts.vendor = subgroupSize == 32 ? DeviceVendor::Nvidia : DeviceVendor::Amd;
  facts.subgroupSize = subgroupSize;
  facts.maxWorkgroupInvocations = facts.maxWorkgroupSize = 1024;
  return facts;
}

std::vector<uint32_t> chooseSeeds(const std::vector<uint32_t>& candidates, const SeedCount& seeds) {
  if (seeds.kind == SeedCount::Kind::All) return candidates;
  const uint64_t count = seeds.kind == SeedCount::Kind::Count
                             ? seeds.count
                             : static_cast<uint64_t>(seeds.share * static_cast<double>(candidates.size()));
  return randomPermutationSeeds(candidates, std::min<uint64_t>(count, candidates.size()), 1);
}

std::string describeStacks(const WarpCounts& counts) {
  std::string text;
  for (uint32_t size = 0; size <= counts.greatestStackSize(); ++size)
    text += fmt::format(" {}: {:.1f} %", size, 100 * counts.perRay(counts.stackSizes[size]));
  return text;
}

void printRows(const TraceableMesh& mesh, const DeviceScene& device, const Cone& cone,
               std::span<const uint32_t> seedFaces, const std::string& title, uint32_t runCount) {
  const TraceScene scene = mesh.scene();
  const std::vector<uint32_t> faces = sampleCones(scene, seedFaces, runCount);
  std::string stacks;
  for (const uint32_t subgroupSize : {32u, 64u}) {
    for (const TraceKernel kernel : {TraceKernel::Ray, TraceKernel::Seed}) {
      for (const bool postpones : {false, true}) {
        WarpSchedule schedule =
            scheduleFor(gpuWith(subgroupSize), kernel, static_cast<uint32_t>(cone.directions.size()));
        schedule.postponesTriangles = postpones;
        const WarpCounts counts = countWarps(scene, device, cone, faces, schedule);
        const auto busy = [&](uint64_t visits, uint64_t steps, uint32_t visitsPerStep) {
          return 100 * static_cast<double>(visits) / static_cast<double>(steps * subgroupSize * visitsPerStep);
        };
        writeOutput(fmt::format(
            "| {} | {} | {} | {} | {:.0f} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {:.0f} % | {:.0f} % |\n", title,
            subgroupSize, kernel == TraceKernel::Ray ? "ray" : "seed", postpones ? "postponed" : "at once",
            warpInstructionsPerRay(counts, schedule, stepCosts(schedule)), counts.perRay(counts.nodeStepCount),
            counts.perRay(counts.triangleStepCount), counts.perRay(counts.nodeCount),
            counts.perRay(counts.triangleCount), busy(counts.nodeCount, counts.nodeStepCount, 1),
            busy(counts.triangleCount, counts.triangleStepCount, postpones ? 2 : 1)));
        stacks = describeStacks(counts);
      }
    }
  }
  writeProgress(fmt::format("{}: depth of the hierarchy {}; rays by the greatest size of their stack:{}", title,
                            device.bvh.depth, stacks));
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  Program program("asdfvk-bench-warp-instructions",
                  "Prints steps and instructions of subgroups per ray. Mesa counted the instructions of a step.");
  program.addMeshes(arguments.meshes);
  program.add("--seeds", arguments.seeds, "numbers of seeds: all, 2000 or 10%");
  program.add("--runs", arguments.runs, "runs of 128 neighbouring cones", {.min = 1});
  return program.run(argc, argv, [&](const RunControl& control) {
    writeOutput(
        "| mesh, seeds | lanes | kernel | triangles | instructions | node steps | triangle steps | nodes | triangles | "
        "lanes busy in nodes | in triangles |\n|---|---:|---|---|---:|---:|---:|---:|---:|---:|---:|\n");
    const Cone cone = makeCone({});
    for (const std::string& path : arguments.meshes) {
      const TraceableMesh mesh(readMesh(path));
      const DeviceScene device = deviceSceneOf(mesh.scene(), cone);
      for (const std::string& seeds : arguments.seeds) {
        control.checkpoint(0);
        printRows(mesh, device, cone, chooseSeeds(mesh.prepared.traceableFaces, parseSeedCount(seeds)),
                  fmt::format("{}, {}", std::filesystem::path(path).stem().string(), seeds), arguments.runs);
      }
    }
  });
}
