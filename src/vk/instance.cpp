#include "vk/instance.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>

#include "asdf_vk/error.h"
#include "vk/result.h"

namespace asdfvk {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onValidationMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                   VkDebugUtilsMessageTypeFlagsEXT,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
  std::string message = data->pMessage;
  // Validation layers since 2025 leave the identifier out of the text.
  if (data->pMessageIdName != nullptr && message.find(data->pMessageIdName) == std::string::npos)
    message = std::string(data->pMessageIdName) + ": " + message;
  static_cast<ValidationLog*>(log)->add(std::move(message));
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(ValidationLog* log) {
  VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = onValidationMessage;
  info.pUserData = log;
  return info;
}

// The headers of Debian 12 do not have VK_EXT_layer_settings.
constexpr const char* kLayerSettings = "VK_EXT_layer_settings";

struct LayerSetting {
  const char* layerName;
  const char* settingName;
  int32_t type;
  uint32_t valueCount;
  const void* values;
};

struct LayerSettingsInfo {
  VkStructureType sType;
  const void* pNext;
  uint32_t settingCount;
  const LayerSetting* settings;
};

/// Enables the checks of shader accesses, because most accesses here are shader accesses. Layers since July 2024 do not
/// check these by default.
LayerSettingsInfo shaderAccessValidation() {
  constexpr auto kLayerSettingsCreateInfo = static_cast<VkStructureType>(1000496000);
  constexpr int32_t kBool32 = 0;
  static const VkBool32 isOn = VK_TRUE;
  static const LayerSetting setting{kValidationLayer, "syncval_shader_accesses_heuristic", kBool32, 1, &isOn};
  return {kLayerSettingsCreateInfo, nullptr, 1, &setting};
}

/// Whether the loader and the drivers, or `layer` if it is given, have the extension.
bool hasExtension(const char* name, const char* layer = nullptr) {
  uint32_t count = 0;
  if (vkEnumerateInstanceExtensionProperties(layer, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

void loadVulkan() {
  static const VkResult result = volkInitialize();
  if (result != VK_SUCCESS) throw Error(ErrorCode::NoVulkanLoader, "no Vulkan loader (libvulkan.so.1) was found");
}

}  // namespace

void ValidationLog::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

Instance::Instance(const InstanceOptions& options) {
  loadVulkan();
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "asdf-vk";
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;

  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  const VkValidationFeatureEnableEXT enable = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  LayerSettingsInfo settings = shaderAccessValidation();
  std::vector<const char*> extensions;
  if (hasExtension(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
    extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    info.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
  }
  if (options.validation) {
    log_ = std::make_shared<ValidationLog>();
    messenger = messengerInfo(log_.get());
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &enable;
    features.pNext = &messenger;
    info.pNext = &features;
    if (hasExtension(kLayerSettings, kValidationLayer)) {
      settings.pNext = &features;
      info.pNext = &settings;
    }
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  requireSuccess(vkCreateInstance(&info, nullptr, &instance_), "creating a Vulkan instance");
  volkLoadInstance(instance_);
  if (!options.validation) return;
  destroyMessenger_ = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
  const VkResult result = vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_);
  if (result == VK_SUCCESS) return;
  vkDestroyInstance(instance_, nullptr);
  requireSuccess(result, "creating the validation messenger");
}

Instance::~Instance() {
  if (messenger_) destroyMessenger_(instance_, messenger_, nullptr);
  // One instance remains until the end of the process, so that the loader keeps the drivers loaded. A process can load
  // NVIDIA's driver (version 580) only about twenty times.
  static std::atomic<bool> oneRemains = false;
  static std::shared_ptr<ValidationLog> logOfRemaining;
  if (oneRemains.exchange(true))
    vkDestroyInstance(instance_, nullptr);
  else
    logOfRemaining = log_;
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const {
  uint32_t count = 0;
  requireSuccess(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "listing Vulkan devices");
  std::vector<VkPhysicalDevice> devices(count);
  if (count > 0)
    requireSuccess(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "listing Vulkan devices");
  devices.resize(count);
  return devices;
}

bool validationRequestedByEnvironment() {
  const char* value = std::getenv("ASDF_VK_VALIDATION");
  return value != nullptr && std::strcmp(value, "0") != 0 && *value != '\0';
}

}  // namespace asdfvk
