#pragma once

#include <volk.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace asdfvk {

/// Messages of the validation layers. The log outlives the instance, because destroying the instance may add messages.
class ValidationLog {
 public:
  void add(std::string message);
  [[nodiscard]] std::vector<std::string> messages() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

struct InstanceOptions {
  /// Core and synchronization validation. Throws Error{Device} if the layer is not installed.
  bool validation = false;
};

/// A Vulkan 1.2 instance. The first one that is destroyed remains until the end of the process. Also lists devices of
/// incomplete implementations (VK_KHR_portability_subset). Throws Error{Device} with the reason if there is no loader
/// or no driver.
class Instance {
 public:
  explicit Instance(const InstanceOptions& options = {});
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] VkInstance handle() const { return instance_; }
  [[nodiscard]] std::vector<VkPhysicalDevice> physicalDevices() const;
  /// Null if validation is off.
  [[nodiscard]] const std::shared_ptr<ValidationLog>& validationLog() const { return log_; }

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  /// A copy, because Volk's global pointer becomes null when an instance without the extension is created.
  PFN_vkDestroyDebugUtilsMessengerEXT destroyMessenger_ = nullptr;
  std::shared_ptr<ValidationLog> log_;
};

/// True if the environment variable ASDF_VK_VALIDATION is set and not "0".
[[nodiscard]] bool validationRequestedByEnvironment();

}  // namespace asdfvk
