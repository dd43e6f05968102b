#include "settings.h"

#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace asdfvk::fake {
namespace {

/// Empty where the variable is not set.
std::string_view valueOf(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

[[noreturn]] void refuse(const char* variable) {
  throw std::invalid_argument(std::string(variable) + "=" + std::string(valueOf(variable)) + " is no valid value");
}

template <typename Number>
std::optional<Number> numberOf(const char* variable, std::string_view text) {
  if (text.empty()) return {};
  const bool isHexadecimal = text.starts_with("0x");
  if (isHexadecimal) text.remove_prefix(2);
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, isHexadecimal ? 16 : 10);
  if (error != std::errc{} || end != text.data() + text.size()) refuse(variable);
  return number;
}

template <typename Number>
void read(const char* variable, std::optional<Number>& number) {
  number = numberOf<Number>(variable, valueOf(variable));
}

std::optional<VkPhysicalDeviceType> typeOf(const char* variable) {
  const std::string_view name = valueOf(variable);
  if (name.empty()) return {};
  if (name == "integrated") return VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
  if (name == "discrete") return VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
  if (name == "virtual") return VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU;
  if (name == "cpu") return VK_PHYSICAL_DEVICE_TYPE_CPU;
  refuse(variable);
}

}  // namespace

Settings readSettings() {
  Settings settings;
  settings.name = valueOf("ASDF_VK_FAKE_NAME");
  if (settings.name.size() >= VK_MAX_PHYSICAL_DEVICE_NAME_SIZE) refuse("ASDF_VK_FAKE_NAME");
  settings.type = typeOf("ASDF_VK_FAKE_TYPE");
  read("ASDF_VK_FAKE_MINOR_VERSION", settings.minorVersion);
  read("ASDF_VK_FAKE_VENDOR", settings.vendor);
  read("ASDF_VK_FAKE_SUBGROUP_SIZE", settings.subgroupSize);
  read("ASDF_VK_FAKE_MIN_SUBGROUP_SIZE", settings.minSubgroupSize);
  read("ASDF_VK_FAKE_MAX_SUBGROUP_SIZE", settings.maxSubgroupSize);
  read("ASDF_VK_FAKE_QUEUES", settings.queueCount);
  read("ASDF_VK_FAKE_TEXELS", settings.texelCount);
  read("ASDF_VK_FAKE_STORAGE_RANGE", settings.storageBufferRange);
  read("ASDF_VK_FAKE_STORAGE_BUFFERS", settings.storageBufferCount);
  read("ASDF_VK_FAKE_WORKGROUP_INVOCATIONS", settings.workgroupInvocations);
  read("ASDF_VK_FAKE_WORKGROUP_SIZE", settings.workgroupSize);
  read("ASDF_VK_FAKE_SHARED_MEMORY", settings.sharedMemoryByteCount);
  read("ASDF_VK_FAKE_MAX_ALLOCATION", settings.maxAllocationByteCount);
  const auto numberOrZero = [](const char* variable) {
    return numberOf<uint32_t>(variable, valueOf(variable)).value_or(0);
  };
  settings.hasSeparateMemory = numberOrZero("ASDF_VK_FAKE_SEPARATE_MEMORY") != 0;
  read("ASDF_VK_FAKE_MAPPABLE_MEMORY", settings.mappableByteCount);
  settings.openingMilliseconds = numberOrZero("ASDF_VK_FAKE_OPENING_MS");
  settings.pipelineMilliseconds = numberOrZero("ASDF_VK_FAKE_PIPELINE_MS");
  read("ASDF_VK_FAKE_POISON", settings.poison);
  return settings;
}

bool losesDeviceAt(uint64_t submission) noexcept {
  constexpr const char* kVariable = "ASDF_VK_FAKE_LOST_AT";
  const std::optional<uint64_t> first = numberOf<uint64_t>(kVariable, valueOf(kVariable));
  return first && submission >= *first;
}

bool lacksMemoryAt(uint64_t allocation) noexcept {
  constexpr const char* kVariable = "ASDF_VK_FAKE_NO_MEMORY_AT";
  std::string_view text = valueOf(kVariable);
  const bool isLasting = text.ends_with('+');
  if (isLasting) text.remove_suffix(1);
  const std::optional<uint64_t> first = numberOf<uint64_t>(kVariable, text);
  return first && (isLasting ? allocation >= *first : allocation == *first);
}

}  // namespace asdfvk::fake
