#pragma once

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <unordered_set>

#include "settings.h"

namespace asdfvk::fake {

/// Functions of the next layer or of the driver. Looked up when the instance is created: later the loader returns those
/// of the first layer.
struct InstanceFunctions {
  PFN_vkGetInstanceProcAddr find = nullptr;
  PFN_vkDestroyInstance destroy = nullptr;
  PFN_vkGetPhysicalDeviceProperties getProperties = nullptr;
  PFN_vkGetPhysicalDeviceProperties2 getProperties2 = nullptr;
  PFN_vkGetPhysicalDeviceMemoryProperties getMemory = nullptr;
  PFN_vkGetPhysicalDeviceMemoryProperties2 getMemory2 = nullptr;
  PFN_vkGetPhysicalDeviceQueueFamilyProperties getQueueFamilies = nullptr;
};

/// An instance, for its physical devices too.
struct InstanceState {
  VkInstance handle = VK_NULL_HANDLE;
  InstanceFunctions next;
  Settings settings;
};

/// A device, for its queues too.
struct DeviceState {
  VkDevice handle = VK_NULL_HANDLE;
  PFN_vkGetDeviceProcAddr nextProcedure = nullptr;
  Settings settings;
  uint32_t driverMemoryType = 0;        ///< Mappable; the one type of the driver that all memory is from.
  bool canRequireSubgroupSize = false;  ///< Whether the program enabled the feature.
  std::atomic<uint64_t> submissionCount = 0;
  std::atomic<uint64_t> allocationCount = 0;
  std::atomic<bool> isLost = false;
  std::mutex queueMutex;  ///< All queues of the program are one of the driver.
  std::mutex mutex;
  std::unordered_set<VkDeviceMemory> unmappable;

  /// The function of the next layer or of the driver.
  template <typename Function>
  [[nodiscard]] Function next(const char* name) const {
    return reinterpret_cast<Function>(nextProcedure(handle, name));
  }
};

/// The structure of that type in a chain of extensions, or null.
template <typename Structure>
[[nodiscard]] const Structure* findStructure(const void* chain, VkStructureType type) {
  const auto* next = static_cast<const VkBaseInStructure*>(chain);
  while (next != nullptr && next->sType != type) next = next->pNext;
  return reinterpret_cast<const Structure*>(next);
}

/// States by dispatchable handle. The loader's pointer at the begin of a handle is the same for an instance and its
/// physical devices, and for a device and its queues.
template <typename State>
class States {
 public:
  template <typename Handle>
  State& add(Handle handle) {
    const std::lock_guard lock(mutex_);
    return *(states_[keyOf(handle)] = std::make_unique<State>());
  }
  template <typename Handle>
  [[nodiscard]] State& of(Handle handle) {
    const std::lock_guard lock(mutex_);
    return *states_.at(keyOf(handle));
  }
  /// Removes the state of that handle.
  template <typename Handle>
  [[nodiscard]] std::unique_ptr<State> take(Handle handle) {
    const std::lock_guard lock(mutex_);
    return std::move(states_.extract(keyOf(handle)).mapped());
  }

 private:
  template <typename Handle>
  static void* keyOf(Handle handle) {
    return *reinterpret_cast<void**>(handle);
  }

  std::mutex mutex_;
  std::unordered_map<void*, std::unique_ptr<State>> states_;
};

inline States<InstanceState>& instances() {
  static States<InstanceState> states;
  return states;
}
inline States<DeviceState>& devices() {
  static States<DeviceState> states;
  return states;
}

/// The layer's functions of physical devices, and of devices; null for other names.
[[nodiscard]] PFN_vkVoidFunction findPhysicalDeviceFunction(const char* name);
[[nodiscard]] PFN_vkVoidFunction findDeviceFunction(const char* name);

/// A type of the driver's memory that buffers can be in, and that the host can map.
[[nodiscard]] uint32_t findMappableType(const InstanceState& instance, VkPhysicalDevice device);
/// The types of separate memory.
enum SeparateMemoryType : uint32_t { kLocalType, kHostType, kCachedHostType, kMappableLocalType };
[[nodiscard]] inline uint32_t separateTypeCount(const Settings& settings) {
  return settings.mappableByteCount ? kMappableLocalType + 1 : kMappableLocalType;
}

}  // namespace asdfvk::fake
