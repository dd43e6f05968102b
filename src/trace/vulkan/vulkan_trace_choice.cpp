#include "trace/vulkan/vulkan_trace_choice.h"

#include <fmt/format.h>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

// The fastest variant by class of device, independent of the share of seeds and the number of rays.
constexpr VulkanTraceChoice kCpuDevice{TraceKernel::Seed, BvhLayout::Wide, BvhFetch::Texel};      // measured
constexpr VulkanTraceChoice kSmallSubgroup{TraceKernel::Seed, BvhLayout::Wide, BvhFetch::Texel};  // as CPU devices
// Not measured yet.
constexpr VulkanTraceChoice kSubgroupOf32{TraceKernel::Ray, BvhLayout::Binary, BvhFetch::Texel};
constexpr VulkanTraceChoice kSubgroupOf64{TraceKernel::Ray, BvhLayout::Binary, BvhFetch::Texel};

constexpr uint32_t kMaxSmallSubgroup = 16;

constexpr std::pair<const char*, TraceKernel> kKernels[]{
    {"seed", TraceKernel::Seed}, {"ray", TraceKernel::Ray}, {"packet", TraceKernel::Packet}};
constexpr std::pair<const char*, BvhLayout> kLayouts[]{{"wide", BvhLayout::Wide}, {"binary", BvhLayout::Binary}};
constexpr std::pair<const char*, BvhFetch> kFetches[]{{"texel", BvhFetch::Texel}, {"storage", BvhFetch::Storage}};

template <typename T>
std::optional<T> valueNamed(const std::string& name, VariantNames<T> names) {
  if (name.empty() || name == "auto") return std::nullopt;
  for (const auto& [candidate, value] : names)
    if (name == candidate) return value;
  throw Error(ErrorCode::UnknownName, fmt::format("no kernel variant is called '{}'", name));
}

template <typename T>
std::string nameIn(VariantNames<T> names, T value) {
  for (const auto& [name, candidate] : names)
    if (candidate == value) return name;
  return {};
}

}  // namespace

VulkanTraceChoice defaultTraceChoice(const DeviceFacts& device) {
  if (device.kind == DeviceKind::Cpu) return kCpuDevice;
  if (device.subgroupSize <= kMaxSmallSubgroup) return kSmallSubgroup;
  return device.subgroupSize <= 32 ? kSubgroupOf32 : kSubgroupOf64;
}

VulkanTraceChoice traceChoiceFor(const DeviceFacts& device, const VulkanTraceRequest& request) {
  const VulkanTraceChoice best = defaultTraceChoice(device);
  return {request.kernel.value_or(best.kernel), request.bvh.value_or(best.bvh), request.fetch.value_or(best.fetch)};
}

VariantNames<TraceKernel> kernelNames() { return kKernels; }
VariantNames<BvhLayout> bvhNames() { return kLayouts; }
VariantNames<BvhFetch> fetchNames() { return kFetches; }

VulkanTraceRequest traceRequestOf(const TraceVariant& variant) {
  return {valueNamed(variant.kernel, kernelNames()), valueNamed(variant.bvh, bvhNames()),
          valueNamed(variant.fetch, fetchNames())};
}

TraceVariant variantOf(const VulkanTraceChoice& choice) {
  return {nameIn(kernelNames(), choice.kernel), nameIn(bvhNames(), choice.bvh), nameIn(fetchNames(), choice.fetch)};
}

}  // namespace asdfvk
