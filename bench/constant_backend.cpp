#include "constant_backend.h"

#include <volk.h>

#include <algorithm>
#include <mutex>
#include <span>
#include <utility>

#include "spirv/constant_lengths.comp.h"
#include "spirv/trace_rays.comp.h"
#include "trace/vk/vulkan_tracer.h"

namespace asdfvk::bench {
namespace {

/// During its lifetime, kernels are compiled from constant_lengths.comp instead of trace_rays.comp.
class ConstantLengths {
 public:
  ConstantLengths() {
    create_ = vkCreateShaderModule;
    vkCreateShaderModule = [](VkDevice device, const VkShaderModuleCreateInfo* info,
                              const VkAllocationCallbacks* callbacks, VkShaderModule* module) {
      VkShaderModuleCreateInfo used = *info;
      if (std::ranges::equal(std::span(info->pCode, info->codeSize / sizeof(uint32_t)), k_trace_rays_comp)) {
        used.pCode = k_constant_lengths_comp;
        used.codeSize = sizeof k_constant_lengths_comp;
      }
      return create_(device, &used, callbacks, module);
    };
  }
  ~ConstantLengths() { vkCreateShaderModule = create_; }
  ConstantLengths(const ConstantLengths&) = delete;
  ConstantLengths& operator=(const ConstantLengths&) = delete;

 private:
  static inline PFN_vkCreateShaderModule create_ = nullptr;
};

}  // namespace

std::unique_ptr<ConeTracer> ConstantBackend::makeTracer(const TraceScene& scene, const Cone& cone,
                                                        const TracerNeeds& needs,
                                                        std::unique_ptr<EncodedScene> encoded) {
  const ConeKernelRequest request{.rayCount = static_cast<uint32_t>(cone.directions.size()),
                                  .writesHits = needs.hits,
                                  .choice = traceChoiceFor(facts(), {}, scene.bvh)};
  std::unique_ptr<VulkanConeKernel>& kernel = kernels_[request];
  if (!kernel) {
    static std::mutex mutex;  // Backends of several threads replace the function.
    const std::lock_guard lock(mutex);
    const ConstantLengths constant;
    kernel = std::make_unique<VulkanConeKernel>(device_, request);
  }
  return makeVulkanTracer(*kernel, scene, cone, std::move(encoded));
}

std::unique_ptr<DevicePredictor> ConstantBackend::makePredictor(const TraceScene& scene, const Cone& cone) {
  if (!predictionKernels_)
    predictionKernels_ = std::make_unique<VulkanPredictionKernels>(device_, cone.definition,
                                                                   static_cast<uint32_t>(cone.directions.size()));
  return makeVulkanPredictor(*predictionKernels_, scene, cone);
}

}  // namespace asdfvk::bench
