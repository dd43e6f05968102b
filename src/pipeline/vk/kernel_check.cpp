#include "pipeline/vk/kernel_check.h"

#include <vector>

#include "pipeline/generated_mesh.h"
#include "pipeline/region.h"
#include "predict/prediction.h"
#include "trace/reference_tracer.h"
#include "trace/vk/vulkan_tracer.h"

namespace asdfvk {
namespace {

constexpr uint32_t kFacesPerSeed = 12;

}  // namespace

TracerCheck checkKernel(const VulkanConeKernel& kernel) {
  const GeneratedMesh generated(halfSquareRing());
  const TraceScene scene = generated.scene.view();
  const Cone cone = makeCone({.rayCount = kernel.rayCount(), .definition = kernel.definition()});
  return checkTracer(*makeVulkanTracer(kernel, scene, cone), scene, cone);
}

TracerCheck checkKernels(const VulkanPredictionKernels& kernels) {
  const GeneratedMesh generated(halfSquareRing());
  const TraceScene scene = generated.scene.view();
  const FaceDomain domain = wholeMesh(generated.scene.prepared);
  const Cone cone = makeCone({.rayCount = kernels.rayCount(), .definition = kernels.definition()});
  std::vector<uint32_t> seeds;
  for (uint32_t face = 0; face < scene.mesh.faceCount(); face += kFacesPerSeed) seeds.push_back(face);
  std::vector<double> values(seeds.size());
  std::vector<ConeHit> hits(seeds.size() * kernels.rayCount());
  makeReferenceTracer(scene, cone)->trace(seeds, {values, hits}, {});

  const SeedHitsView input{seeds, hits};
  const std::unique_ptr<DevicePredictor> predictor = makeVulkanPredictor(kernels, scene, cone);
  const UnsetVector<double> expected = predictValues(scene, domain, cone, input, {}).values,
                            predicted = predictValues(scene, domain, cone, input, {}, {}, predictor.get()).values;
  return compareValues(predicted, expected, scene.geometry.bounds.diagonal());
}

}  // namespace asdfvk
