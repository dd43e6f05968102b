#include <doctest/doctest.h>

#include "asdf_vk/error.h"
#include "support/require_failure.h"
#include "trace/vk/vulkan_cone_kernel.h"

using namespace asdfvk;

TEST_CASE("a kernel whose subgroup operations the device lacks is refused with the name of the operation") {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  DeviceFacts facts = describeDevice(physical);
  const auto make = [&](TraceKernel kernel) {
    const Device device(physical, facts);
    (void)VulkanConeKernel(device, {30, false, VulkanTraceChoice{kernel, BvhFetch::Storage}});
  };
  facts.hasSubgroupArithmetic = false;
  CHECK_NOTHROW(make(TraceKernel::Seed));
  CHECK_NOTHROW(make(TraceKernel::Ray));
  test::requireFailure([&] { make(TraceKernel::Packet); }, ErrorCode::KernelUnsupported, "no subgroup arithmetic");
  facts.hasSubgroupVote = false;
  for (const TraceKernel kernel : {TraceKernel::Seed, TraceKernel::Ray, TraceKernel::Packet})
    test::requireFailure([&] { make(kernel); }, ErrorCode::KernelUnsupported, "no subgroup vote");
}
