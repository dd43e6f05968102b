// A Vulkan layer for tests: a device of the driver looks like another one, and fails on request. settings.h has the
// environment variables. It stands between the validation layer and the driver, so that the validation layer sees the
// same device as the program.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <thread>
#include <vector>

#include "state.h"

namespace asdfvk::fake {
namespace {

/// The layer's link in the chain of the loader.
template <typename LinkInfo>
LinkInfo* findLink(const void* chain, VkStructureType type) {
  for (auto* info = static_cast<const LinkInfo*>(chain); info != nullptr;
       info = static_cast<const LinkInfo*>(info->pNext))
    if (info->sType == type && info->function == VK_LAYER_LINK_INFO) return const_cast<LinkInfo*>(info);
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                              VkInstance* handle) {
  auto* link = findLink<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  Settings settings;
  try {
    settings = readSettings();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fake device: %s\n", error.what());
    return VK_ERROR_INITIALIZATION_FAILED;
  }
  const PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(next(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, allocator, handle);
  if (result != VK_SUCCESS) return result;
  InstanceState& instance = instances().add(*handle);
  instance.handle = *handle;
  instance.settings = settings;
  instance.next.find = next;
  const auto find = [&]<typename Function>(Function& function, const char* name) {
    function = reinterpret_cast<Function>(next(*handle, name));
  };
  find(instance.next.destroy, "vkDestroyInstance");
  find(instance.next.getProperties, "vkGetPhysicalDeviceProperties");
  find(instance.next.getProperties2, "vkGetPhysicalDeviceProperties2");
  find(instance.next.getMemory, "vkGetPhysicalDeviceMemoryProperties");
  find(instance.next.getMemory2, "vkGetPhysicalDeviceMemoryProperties2");
  find(instance.next.getQueueFamilies, "vkGetPhysicalDeviceQueueFamilyProperties");
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance handle, const VkAllocationCallbacks* allocator) {
  if (handle == VK_NULL_HANDLE) return;
  instances().take(handle)->next.destroy(handle, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* handle) {
  auto* link = findLink<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const InstanceState& instance = instances().of(physical);
  const PFN_vkGetInstanceProcAddr nextOfInstance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  const PFN_vkGetDeviceProcAddr next = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  std::this_thread::sleep_for(std::chrono::milliseconds(instance.settings.openingMilliseconds));
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(nextOfInstance(instance.handle, "vkCreateDevice"));
  VkDeviceCreateInfo changed = *info;
  std::vector<VkDeviceQueueCreateInfo> queues(info->pQueueCreateInfos,
                                              info->pQueueCreateInfos + info->queueCreateInfoCount);
  if (instance.settings.queueCount)
    for (VkDeviceQueueCreateInfo& family : queues) family.queueCount = 1;
  changed.pQueueCreateInfos = queues.data();
  const VkResult result = create(physical, &changed, allocator, handle);
  if (result != VK_SUCCESS) return result;
  DeviceState& device = devices().add(*handle);
  device.handle = *handle;
  device.nextProcedure = next;
  device.settings = instance.settings;
  device.driverMemoryType = findMappableType(instance, physical);
  const auto* sizes = findStructure<VkPhysicalDeviceSubgroupSizeControlFeaturesEXT>(
      info->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES_EXT);
  device.canRequireSubgroupSize = sizes != nullptr && sizes->subgroupSizeControl == VK_TRUE;
  return VK_SUCCESS;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceFunction(VkDevice handle, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(getDeviceFunction);
  if (const PFN_vkVoidFunction own = findDeviceFunction(name)) return own;
  return devices().of(handle).nextProcedure(handle, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceFunction(VkInstance handle, const char* name) {
  const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
  if (is("vkGetInstanceProcAddr")) return reinterpret_cast<PFN_vkVoidFunction>(getInstanceFunction);
  if (is("vkGetDeviceProcAddr")) return reinterpret_cast<PFN_vkVoidFunction>(getDeviceFunction);
  if (is("vkCreateInstance")) return reinterpret_cast<PFN_vkVoidFunction>(createInstance);
  if (is("vkDestroyInstance")) return reinterpret_cast<PFN_vkVoidFunction>(destroyInstance);
  if (is("vkCreateDevice")) return reinterpret_cast<PFN_vkVoidFunction>(createDevice);
  if (const PFN_vkVoidFunction own = findPhysicalDeviceFunction(name)) return own;
  if (const PFN_vkVoidFunction own = findDeviceFunction(name)) return own;
  return handle == VK_NULL_HANDLE ? nullptr : instances().of(handle).next.find(handle, name);
}

}  // namespace
}  // namespace asdfvk::fake

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* layer) {
  layer->loaderLayerInterfaceVersion = 2;
  layer->pfnGetInstanceProcAddr = asdfvk::fake::getInstanceFunction;
  layer->pfnGetDeviceProcAddr = asdfvk::fake::getDeviceFunction;
  layer->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
