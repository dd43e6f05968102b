// The instructions of a step, compared with those of Mesa's compiler for AMD GPUs. The compiler needs no GPU.
#include "warps/step_costs.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/mesa_driver.h"
#include "trace/radv_compiler.h"
#include "trace/vk/vulkan_cone_kernel.h"

namespace asdfvk::bench {

TEST_CASE("a step has the instructions of a loop of RADV, within 2 %") {
  const std::string manifest = test::mesaDriver("radeon");
  if (manifest.empty()) {
    MESSAGE("skipped: no RADV driver");
    return;
  }
  const RadvCompiler radv(manifest, "navi21");
  if (!radv.isUsable() || radv.majorVersion() != 22) {
    MESSAGE("skipped: not the compiler of the stored numbers: " << radv.facts().driver);
    return;
  }
  const VulkanTraceChoice choice = defaultTraceChoice(radv.facts());
  const VulkanWorkgroupShape shape = workgroupShapeFor(radv.facts(), 30, choice.kernel);
  for (const bool postpones : {false, true}) {
    CAPTURE(postpones);
    VulkanWalkShape walk = walkShapeFor(radv.facts());
    walk.postponesTriangles = postpones;
    const std::vector<uint32_t> loops =
        radv.compile(describeRays({.rayCount = 30, .writesHits = true}, choice, shape, walk)).innerLoops();
    REQUIRE(loops.size() == 2);
    const StepCosts& costs = stepCosts({shape, postpones, 32});
    CHECK(loops[0] == doctest::Approx(costs.node).epsilon(0.02));
    CHECK(loops[1] == doctest::Approx(costs.triangles).epsilon(0.02));
  }
}

}  // namespace asdfvk::bench
