#include "vk/device_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace asdfvk {
namespace {

constexpr uint32_t kRequiredApiVersion = (1u << 22) | (2u << 12);  // Vulkan 1.2

int rank(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::Discrete:
      return 0;
    case DeviceKind::Integrated:
      return 1;
    case DeviceKind::Virtual:
      return 2;
    case DeviceKind::Other:
      return 3;
    case DeviceKind::Cpu:
      return 4;
  }
  return 5;
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool isSelected(const DeviceFacts& device, uint32_t index, const std::string& selector) {
  if (selector.empty()) return true;
  uint32_t wanted = 0;
  const char* end = selector.data() + selector.size();
  if (const auto [rest, error] = std::from_chars(selector.data(), end, wanted); error == std::errc{} && rest == end)
    return wanted == index;
  return lowerCase(device.name).find(lowerCase(selector)) != std::string::npos;
}

/// Empty when nothing speaks against the device.
std::string refusal(const DeviceFacts& device, uint32_t index, const DeviceRequest& request) {
  if (!isSelected(device, index, request.selector))
    return fmt::format("is not the requested device '{}'", request.selector);
  if (device.apiVersion < kRequiredApiVersion)
    return fmt::format("supports Vulkan {}.{} only, 1.2 is needed; update its driver", (device.apiVersion >> 22) & 0x7f,
                       (device.apiVersion >> 12) & 0x3ff);
  if (!device.computeQueueFamily) return "has no queue for compute work";
  if (request.requireGpu && device.kind == DeviceKind::Cpu) return "is a CPU device and a GPU was required";
  return {};
}

}  // namespace

std::string_view toString(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::Discrete:
      return "discrete GPU";
    case DeviceKind::Integrated:
      return "integrated GPU";
    case DeviceKind::Virtual:
      return "virtual GPU";
    case DeviceKind::Cpu:
      return "CPU";
    case DeviceKind::Other:
      return "other";
  }
  return "other";
}

DeviceChoice chooseDevice(std::span<const DeviceFacts> devices, const DeviceRequest& request) {
  DeviceChoice choice;
  for (uint32_t i = 0; i < devices.size(); ++i) {
    const std::string reason = refusal(devices[i], i, request);
    choice.reasons.push_back(reason.empty() ? std::string{} : fmt::format("{} {}", devices[i].name, reason));
    if (reason.empty() && (!choice.index || rank(devices[i].kind) < rank(devices[*choice.index].kind)))
      choice.index = i;
  }
  for (uint32_t i = 0; i < devices.size(); ++i) {
    if (!choice.reasons[i].empty()) continue;
    choice.reasons[i] = i == *choice.index
                            ? fmt::format("{} ({}) is chosen", devices[i].name, toString(devices[i].kind))
                            : fmt::format("{} ({}) is usable but ranks behind {}", devices[i].name,
                                          toString(devices[i].kind), devices[*choice.index].name);
  }
  return choice;
}

}  // namespace asdfvk
