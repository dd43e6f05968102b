#include "smooth/vulkan/vulkan_bilateral.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "shared/bilateral_layout.h"
#include "spirv/bilateral.comp.h"
#include "vk/command_list.h"

namespace asdfvk {
namespace {

constexpr uint32_t kBindingCount = 4;
constexpr uint32_t kWantedLaneCount = 64;

uint32_t laneCount(const DeviceFacts& facts) {
  return std::bit_floor(std::min({kWantedLaneCount, facts.maxWorkgroupInvocations, facts.maxWorkgroupSize}));
}

ComputePipelineDescription describePass(const DeviceFacts& facts) {
  return {"bilateral.comp",
          k_bilateral_comp,
          std::vector<VkDescriptorType>(kBindingCount, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
          sizeof(BilateralPush),
          {/* local_size_x= */ laneCount(facts)}};
}

void requireFits(const DeviceFacts& facts, const DualGraph& graph) {
  const uint64_t byteCount = sizeof(uint32_t) * std::max(graph.offsets.size(), graph.neighbours.size());
  if (byteCount > facts.maxStorageBufferRange)
    throw Error(ErrorCode::DeviceLimit,
                fmt::format("smoothing {} faces needs {} MiB in one buffer and {} allows {}; smooth on the CPU",
                            graph.faceCount(), (byteCount >> 20) + 1, facts.name, facts.maxStorageBufferRange >> 20));
}

/// The exponent of the power of two that the values are divided by on their way to float32.
int exponentOf(std::span<const double> values) {
  double largest = 0;
  for (double value : values)
    if (!std::isnan(value)) largest = std::max(largest, std::abs(value));
  int exponent = 0;
  std::frexp(largest, &exponent);
  return exponent;
}

std::vector<float> toScaled(std::span<const double> values, int exponent) {
  std::vector<float> scaled(values.size());
  for (size_t i = 0; i < values.size(); ++i)
    scaled[i] = std::isnan(values[i]) ? kNoScaledValue : static_cast<float>(std::ldexp(values[i], -exponent));
  return scaled;
}

std::vector<double> fromScaled(std::span<const float> scaled, int exponent) {
  std::vector<double> values(scaled.size());
  for (size_t i = 0; i < scaled.size(); ++i)
    values[i] = scaled[i] == kNoScaledValue ? std::numeric_limits<double>::quiet_NaN()
                                            : std::ldexp(static_cast<double>(scaled[i]), exponent);
  return values;
}

template <typename T>
Buffer uploadArray(const Device& device, const std::vector<T>& array, VkBufferUsageFlags usage = 0) {
  return uploadBuffer(device, std::as_bytes(std::span(array)), usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

/// One pass over all faces, in as many dispatches as the device's largest takes.
void recordPass(CommandList& commands, const ComputePipeline& pipeline, const BindingSet& bindings,
                const DeviceFacts& facts, uint32_t faceCount, uint32_t window) {
  const uint64_t lanes = laneCount(facts);
  for (uint64_t first = 0; first < faceCount;) {
    const uint64_t groupCount = std::min<uint64_t>((faceCount - first + lanes - 1) / lanes, facts.maxWorkgroupCount);
    commands.dispatch(pipeline, bindings, bytesOf(BilateralPush{static_cast<uint32_t>(first), faceCount, window}),
                      static_cast<uint32_t>(groupCount));
    first += groupCount * lanes;
  }
  commands.barrier();
}

}  // namespace

VulkanBilateralKernel::VulkanBilateralKernel(const Device& device) : pass(device, describePass(device.facts())) {}

std::vector<double> smoothBilaterallyOnDevice(const Device& device, const VulkanBilateralKernel& kernel,
                                              const DualGraph& graph, std::span<const double> values,
                                              const BilateralOptions& options) {
  requireValid(options);
  ASDFVK_CHECK_OP(values.size(), ==, size_t{graph.faceCount()});
  requireFits(device.facts(), graph);
  if (values.empty() || options.passes == 0) return {values.begin(), values.end()};
  const int exponent = exponentOf(values);
  std::vector<float> scaled = toScaled(values, exponent);
  const Buffer offsets = uploadArray(device, graph.offsets), neighbours = uploadArray(device, graph.neighbours);
  // The second one's contents are written before they are read.
  const std::array<Buffer, 2> fields{uploadArray(device, scaled, VK_BUFFER_USAGE_TRANSFER_SRC_BIT),
                                     uploadArray(device, scaled, VK_BUFFER_USAGE_TRANSFER_SRC_BIT)};
  const auto bind = [&](const Buffer& from, const Buffer& to) {
    return std::array<Binding, kBindingCount>{offsets, neighbours, from, to};
  };
  const std::array<BindingSet, 2> bindings{BindingSet(device, kernel.pass, bind(fields[0], fields[1])),
                                           BindingSet(device, kernel.pass, bind(fields[1], fields[0]))};
  CommandList commands(device);
  commands.begin();
  for (uint32_t pass = 0; pass < options.passes; ++pass)
    recordPass(commands, kernel.pass, bindings[pass % 2], device.facts(), graph.faceCount(), options.window);
  commands.submitAndWait();
  downloadBuffer(device, fields[options.passes % 2], std::as_writable_bytes(std::span(scaled)));
  return fromScaled(scaled, exponent);
}

}  // namespace asdfvk
