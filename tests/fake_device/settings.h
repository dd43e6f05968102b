#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <string>

namespace asdfvk::fake {

/// Properties that the layer reports instead of those of the driver; unset ones are the driver's. Read from the
/// environment when an instance is created. Numbers are decimal, or hexadecimal after "0x". A limit is never larger
/// than that of the driver.
struct Settings {
  std::optional<uint32_t> minorVersion;      ///< ASDF_VK_FAKE_MINOR_VERSION: of Vulkan 1, with patch version 0
  std::string name;                          ///< ASDF_VK_FAKE_NAME: of the device
  std::optional<VkPhysicalDeviceType> type;  ///< ASDF_VK_FAKE_TYPE: integrated, discrete, virtual or cpu
  std::optional<uint32_t> vendor;            ///< ASDF_VK_FAKE_VENDOR: PCI id
  std::optional<uint32_t> subgroupSize;      ///< ASDF_VK_FAKE_SUBGROUP_SIZE: reported only
  /// ASDF_VK_FAKE_MIN_SUBGROUP_SIZE, ASDF_VK_FAKE_MAX_SUBGROUP_SIZE: sizes that compute pipelines can require. The
  /// driver, which has one size, does not see the required size; other sizes fail.
  std::optional<uint32_t> minSubgroupSize, maxSubgroupSize;
  std::optional<uint32_t> queueCount;              ///< ASDF_VK_FAKE_QUEUES: of a family; all are one of the driver
  std::optional<uint32_t> texelCount;              ///< ASDF_VK_FAKE_TEXELS: maxTexelBufferElements
  std::optional<uint32_t> storageBufferRange;      ///< ASDF_VK_FAKE_STORAGE_RANGE: bytes
  std::optional<uint32_t> storageBufferCount;      ///< ASDF_VK_FAKE_STORAGE_BUFFERS: per stage
  std::optional<uint32_t> workgroupInvocations;    ///< ASDF_VK_FAKE_WORKGROUP_INVOCATIONS
  std::optional<uint32_t> workgroupSize;           ///< ASDF_VK_FAKE_WORKGROUP_SIZE: in x and y
  std::optional<uint32_t> sharedMemoryByteCount;   ///< ASDF_VK_FAKE_SHARED_MEMORY
  std::optional<uint64_t> maxAllocationByteCount;  ///< ASDF_VK_FAKE_MAX_ALLOCATION
  /// ASDF_VK_FAKE_SEPARATE_MEMORY=1: memory that is local to the device and cannot be mapped, and memory of the host.
  bool hasSeparateMemory = false;
  /// ASDF_VK_FAKE_MAPPABLE_MEMORY: bytes of the device that the host maps, in a heap of their own; with separate
  /// memory.
  std::optional<uint64_t> mappableByteCount;
  uint32_t openingMilliseconds = 0;   ///< ASDF_VK_FAKE_OPENING_MS: that the creation of a device takes longer
  uint32_t pipelineMilliseconds = 0;  ///< ASDF_VK_FAKE_PIPELINE_MS: that the creation of a pipeline takes longer
  std::optional<uint32_t> poison;  ///< ASDF_VK_FAKE_POISON: word that fills fresh memory, for example a NaN, 0x7fc00001
};

/// Throws std::invalid_argument with the name of a variable that has no valid value.
[[nodiscard]] Settings readSettings();

/// ASDF_VK_FAKE_LOST_AT=n: submission n of a device, counted from 1, and each later one fail with VK_ERROR_DEVICE_LOST.
/// Read at each submission.
[[nodiscard]] bool losesDeviceAt(uint64_t submission) noexcept;

/// ASDF_VK_FAKE_NO_MEMORY_AT=n, or n+: the allocation number n of a device, counted from 1, fails for want of device
/// memory; with + each later one too. Read at each allocation.
[[nodiscard]] bool lacksMemoryAt(uint64_t allocation) noexcept;

}  // namespace asdfvk::fake
