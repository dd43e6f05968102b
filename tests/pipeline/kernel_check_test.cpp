#include "pipeline/vk/kernel_check.h"

#include <doctest/doctest.h>

#include "pipeline/generated_mesh.h"
#include "support/test_device.h"

using namespace asdfvk;

TEST_CASE("kernels of a healthy device agree with the reference on the mesh of the first use") {
  const test::ValidatedDevice device;
  const GeneratedMesh generated(halfSquareRing());
  const TraceScene scene = generated.scene.view();
  CHECK(scene.mesh.faceCount() == 768);
  CHECK(generated.scene.prepared.warnings.empty());
  CHECK(scene.bvh.depth >= 7);  // The wide hierarchy has at least three levels.
  for (const Definition definition : {Definition::Paper, Definition::Cgal}) {
    for (const uint32_t rayCount : {1u, 30u}) {
      CAPTURE(rayCount);
      const VulkanConeKernel kernel(*device, {.rayCount = rayCount, .writesHits = true, .definition = definition});
      const TracerCheck check = checkKernel(kernel);
      // The check computes 64 faces. A face has no value if all of its hits are false.
      CHECK(check.comparedCount > 50);
      CHECK(check.differingCount <= 1);  // A ray may graze an edge.
      const TracerCheck predictions = checkKernels(VulkanPredictionKernels(*device, definition, rayCount));
      CHECK(predictions.comparedCount > 700);
      CHECK(predictions.differingCount < 10);
    }
  }
}
