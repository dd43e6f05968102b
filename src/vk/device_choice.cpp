#include "vk/device_choice.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "core/text.h"

namespace asdfvk {
namespace {

constexpr uint32_t kRequiredApiVersion = (1u << 22) | (2u << 12);  // Vulkan 1.2

/// Whether `digits` is a whole number within `text`: "RTX 4090" has the number 4090, but not 90.
bool holdsNumber(const std::string& text, const std::string& digits) {
  const auto isDigit = [&](size_t i) { return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])); };
  for (size_t at = text.find(digits); at != std::string::npos; at = text.find(digits, at + 1))
    if ((at == 0 || !isDigit(at - 1)) && !isDigit(at + digits.size())) return true;
  return false;
}

bool isSelected(const DeviceFacts& device, uint32_t index, size_t deviceCount, const std::string& selector) {
  if (selector.empty()) return true;
  if (!std::all_of(selector.begin(), selector.end(), [](unsigned char c) { return std::isdigit(c); }))
    return lowerCase(device.name).find(lowerCase(selector)) != std::string::npos;
  const auto wanted = numberIn<uint32_t>(selector);
  return wanted && *wanted < deviceCount ? wanted == index : holdsNumber(device.name, selector);
}

/// Empty if the device is accepted.
std::string refusal(const DeviceFacts& device, uint32_t index, size_t deviceCount, const DeviceRequest& request) {
  if (!isSelected(device, index, deviceCount, request.selector))
    return fmt::format("is not the requested device '{}'", request.selector);
  if (device.apiVersion < kRequiredApiVersion)
    return fmt::format("supports Vulkan {}.{} only, 1.2 is needed; update its driver", (device.apiVersion >> 22) & 0x7f,
                       (device.apiVersion >> 12) & 0x3ff);
  if (!device.computeQueueFamily) return "has no queue for compute work";
  if (request.requireGpu && device.isCpu()) return "is a CPU device and a GPU was required";
  return {};
}

}  // namespace

std::string_view toString(DeviceKind kind) {
  constexpr std::array<std::string_view, 5> kNames{"discrete GPU", "integrated GPU", "virtual GPU", "other", "CPU"};
  static_assert(static_cast<size_t>(DeviceKind::Cpu) + 1 == kNames.size());
  return kNames[static_cast<size_t>(kind)];
}

bool llvmpipeEndsLongLoops(std::string_view driverInfo) {
  constexpr std::string_view kPrefix = "Mesa ";
  constexpr uint32_t kFirstWithoutLimit = 25;
  if (!driverInfo.starts_with(kPrefix)) return true;
  uint32_t major = 0;
  const std::string_view version = driverInfo.substr(kPrefix.size());
  return std::from_chars(version.data(), version.data() + version.size(), major).ec != std::errc{} ||
         major < kFirstWithoutLimit;
}

bool prefersTexels(const DeviceFacts& device) {
  constexpr uint64_t kTexelByteCount = 16;
  return device.isCpu() && device.maxTexelBufferElements >= device.maxStorageBufferRange / kTexelByteCount;
}

DeviceChoice chooseDevice(std::span<const DeviceFacts> devices, const DeviceRequest& request) {
  DeviceChoice choice;
  for (uint32_t i = 0; i < devices.size(); ++i) {
    choice.reasons.push_back(refusal(devices[i], i, devices.size(), request));
    if (!choice.reasons[i].empty()) continue;
    if (!choice.index || devices[i].kind < devices[*choice.index].kind) choice.index = i;
  }
  for (uint32_t i = 0; i < devices.size(); ++i) {
    if (!choice.reasons[i].empty()) continue;
    choice.reasons[i] = i == *choice.index ? "chosen"
                                           : fmt::format("usable but ranks behind device {}, {}", *choice.index,
                                                         devices[*choice.index].name);
  }
  return choice;
}

}  // namespace asdfvk
