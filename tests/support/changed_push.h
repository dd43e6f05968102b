#pragma once

#include <volk.h>

#include <cstring>

namespace asdfvk::test {

/// While it exists, `change` changes the push constants of this type, in fact all of its size.
template <typename Push>
class ChangedPush {
 public:
  using Change = void (*)(Push&);

  explicit ChangedPush(Change change) : push_(vkCmdPushConstants) {
    original = push_;
    changePush = change;
    vkCmdPushConstants = [](VkCommandBuffer commands, VkPipelineLayout layout, VkShaderStageFlags stages,
                            uint32_t offset, uint32_t byteCount, const void* bytes) {
      Push push;
      if (byteCount != sizeof push) return original(commands, layout, stages, offset, byteCount, bytes);
      std::memcpy(&push, bytes, sizeof push);
      changePush(push);
      original(commands, layout, stages, offset, byteCount, &push);
    };
  }
  ~ChangedPush() { vkCmdPushConstants = push_; }
  ChangedPush(const ChangedPush&) = delete;
  ChangedPush& operator=(const ChangedPush&) = delete;

 private:
  static inline PFN_vkCmdPushConstants original = nullptr;
  static inline Change changePush = nullptr;
  PFN_vkCmdPushConstants push_;
};

}  // namespace asdfvk::test
