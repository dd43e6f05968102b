// Occupancy of the kernels on AMD GPUs, as Mesa's compiler reports it without the hardware.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "radv_compiler.h"
#include "support/mesa_driver.h"
#include "trace/vk/vulkan_cone_kernel.h"

using namespace asdfvk;

namespace {

ComputePipelineDescription conesOn(const DeviceFacts& facts, TraceKernel kernel, const VulkanWalkShape& walk) {
  const ConeKernelRequest request{.rayCount = 30, .writesHits = true};
  VulkanTraceChoice choice = defaultTraceChoice(facts);
  choice.kernel = kernel;
  return describeRays(request, choice, workgroupShapeFor(facts, request.rayCount, kernel), walk);
}

constexpr const char* kOccupancy = "Subgroups per SIMD";

std::string rowOf(const std::string& name, RadvKernel& kernel) {
  std::string row = name + ": " + std::to_string(kernel.statistics[kOccupancy]) + " subgroups, " +
                    std::to_string(kernel.statistics["VGPRs"]) + " VGPRs, inner loops";
  for (const uint32_t size : kernel.innerLoops()) row += " " + std::to_string(size);
  return row;
}

}  // namespace

TEST_CASE("the stacks of a lane leave AMD GPUs their occupancy" * doctest::test_suite("slow")) {
  const std::string manifest = test::mesaDriver("radeon");
  if (manifest.empty()) {
    MESSAGE("skipped: no RADV driver");
    return;
  }
  struct Family {
    std::string name;
    uint64_t rayCount, seedCount;  // At least so many subgroups per SIMD.
  };
  std::vector<Family> families;
  {
    const RadvCompiler radv(manifest, "navi21");
    if (!radv.isUsable()) {
      MESSAGE("skipped: RADV has no statistics of pipelines: " << radv.facts().driver);
      return;
    }
    MESSAGE(radv.facts().driver);
    families = {{"vega10", 3, 3}, {"navi21", 10, 12}};
    // The name of the family Navi 31 changed between these versions.
    if (radv.majorVersion() == 22) families.push_back({"gfx1100", 16, 16});
    if (radv.majorVersion() >= 25) families.push_back({"navi31", 16, 16});
  }
  for (const Family& family : families) {
    CAPTURE(family.name);
    const RadvCompiler radv(manifest, family.name);
    REQUIRE(radv.isUsable());
    const VulkanWalkShape walk = walkShapeFor(radv.facts());
    RadvKernel ray = radv.compile(conesOn(radv.facts(), TraceKernel::Ray, walk)),
               seed = radv.compile(conesOn(radv.facts(), TraceKernel::Seed, walk));
    MESSAGE(rowOf(family.name + ", ray", ray));
    MESSAGE(rowOf(family.name + ", seed", seed));
    CHECK(ray.statistics[kOccupancy] >= family.rayCount);
    CHECK(seed.statistics[kOccupancy] >= family.seedCount);
    for (RadvKernel* kernel : {&ray, &seed}) {
      CHECK(kernel->statistics["Scratch size"] > 0);
      CHECK(kernel->statistics["Spilled VGPRs"] == 0);
    }
  }
  // Controls: stacks in registers cost a third of the occupancy or more, with and without postponed triangles.
  for (const Family& family : families) {
    CAPTURE(family.name);
    const RadvCompiler radv(manifest, family.name);
    for (const bool postpones : {false, true}) {
      CAPTURE(postpones);
      VulkanWalkShape walk = walkShapeFor(radv.facts());
      walk.postponesTriangles = postpones;
      RadvKernel inMemory = radv.compile(conesOn(radv.facts(), TraceKernel::Seed, walk));
      walk.stackSize = kMaxBvhDepth;
      RadvKernel inRegisters = radv.compile(conesOn(radv.facts(), TraceKernel::Seed, walk));
      const std::string name = family.name + (postpones ? ", seed, postponed" : ", seed, at once");
      MESSAGE(rowOf(name + ", stack in memory", inMemory));
      MESSAGE(rowOf(name + ", stack in registers", inRegisters));
      CHECK(3 * inRegisters.statistics[kOccupancy] <= 2 * inMemory.statistics[kOccupancy]);
      CHECK(inRegisters.statistics["Scratch size"] < inMemory.statistics["Scratch size"]);
    }
  }
}
