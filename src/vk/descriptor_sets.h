#pragma once

#include <volk.h>

#include <vector>

namespace asdfvk {

/// Descriptor sets of a device, from few pools.
class DescriptorSets {
 public:
  explicit DescriptorSets(VkDevice device) : device_(device) {}
  ~DescriptorSets();
  DescriptorSets(const DescriptorSets&) = delete;
  DescriptorSets& operator=(const DescriptorSets&) = delete;

  struct Set {
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet handle = VK_NULL_HANDLE;
  };
  /// Throws Error of kind Device.
  [[nodiscard]] Set take(VkDescriptorSetLayout layout);
  /// Precondition: no submitted work uses the set.
  void give(const Set& set) noexcept { vkFreeDescriptorSets(device_, set.pool, 1, &set.handle); }

 private:
  void addPool();

  VkDevice device_;
  std::vector<VkDescriptorPool> pools_;
};

}  // namespace asdfvk
