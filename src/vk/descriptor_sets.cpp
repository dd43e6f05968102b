#include "vk/descriptor_sets.h"

#include <array>

#include "vk/result.h"

namespace asdfvk {
namespace {

constexpr uint32_t kSetCount = 64;                     // In one pool.
constexpr uint32_t kDescriptorCount = 12 * kSetCount;  // For each type. No set has more than 12 descriptors.

}  // namespace

DescriptorSets::~DescriptorSets() {
  for (const VkDescriptorPool pool : pools_) vkDestroyDescriptorPool(device_, pool, nullptr);
}

DescriptorSets::Set DescriptorSets::take(VkDescriptorSetLayout layout) {
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  Set set;
  const auto takeFrom = [&](VkDescriptorPool pool) {
    info.descriptorPool = set.pool = pool;
    return vkAllocateDescriptorSets(device_, &info, &set.handle);
  };
  for (const VkDescriptorPool pool : pools_)
    if (takeFrom(pool) == VK_SUCCESS) return set;
  addPool();
  requireSuccess(takeFrom(pools_.back()), "allocating descriptors");
  return set;
}

void DescriptorSets::addPool() {
  constexpr std::array<VkDescriptorPoolSize, 2> kSizes{{{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kDescriptorCount},
                                                        {VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, kDescriptorCount}}};
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  info.maxSets = kSetCount;
  info.poolSizeCount = static_cast<uint32_t>(kSizes.size());
  info.pPoolSizes = kSizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  requireSuccess(vkCreateDescriptorPool(device_, &info, nullptr, &pool), "creating a descriptor pool");
  pools_.push_back(pool);
}

}  // namespace asdfvk
