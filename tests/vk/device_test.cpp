#include <doctest/doctest.h>

#include <cstring>
#include <numeric>
#include <vector>

#include "asdf_vk/error.h"
#include "shared/specialization_ids.h"
#include "spirv/fill.comp.h"
#include "support/test_device.h"
#include "vk/buffer.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

using namespace asdfvk;

namespace {

struct FillPush {
  uint32_t value, wordCount;
};

ComputePipelineDescription fillDescription() {
  return {"fill.comp", k_fill_comp, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}, sizeof(FillPush), {{kLocalSizeXId, 64}}};
}

}  // namespace

TEST_CASE("bytes uploaded come back the same") {
  const test::ValidatedDevice device;
  std::vector<uint32_t> words(100'000);
  std::iota(words.begin(), words.end(), 7u);
  const Buffer buffer = uploadBuffer(*device, std::as_bytes(std::span(words)),
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  std::vector<uint32_t> back(words.size());
  downloadBuffer(*device, buffer, std::as_writable_bytes(std::span(back)));
  CHECK(back == words);
}

TEST_CASE("a buffer that is not mapped goes through the staging copies") {
  const test::ValidatedDevice device;
  std::vector<uint32_t> words(70'000'000 / 4 + 13);  // more than one piece
  std::iota(words.begin(), words.end(), 3u);
  const Buffer buffer =
      uploadBuffer(*device, std::as_bytes(std::span(words)), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::DeviceOnly);
  REQUIRE(buffer.mapped() == nullptr);
  std::vector<uint32_t> back(words.size());
  downloadBuffer(*device, buffer, std::as_writable_bytes(std::span(back)));
  CHECK(back == words);
}

TEST_CASE("a kernel with a specialization constant and push constants fills a buffer") {
  const test::ValidatedDevice device;
  const ComputePipeline fill(*device, fillDescription());
  const Buffer buffer(*device, 1000 * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::HostVisible);
  const Binding bindings[] = {buffer};
  const BindingSet set(*device, fill, bindings);
  CommandList commands(*device);
  commands.begin();
  commands.dispatch(fill, set, bytesOf(FillPush{5, 1000}), 16);
  commands.barrier();
  commands.dispatch(fill, set, bytesOf(FillPush{9, 500}), 8);
  commands.barrier();
  commands.submitAndWait();
  const std::span<uint32_t> words = buffer.mappedAs<uint32_t>();
  CHECK(words[0] == 9);
  CHECK(words[499] == 508);
  CHECK(words[500] == 505);
  CHECK(words[999] == 1004);
}

TEST_CASE("control: the validation layers report a missing barrier and a wrong call") {
  const auto instance = std::make_unique<Instance>(InstanceOptions{.validation = true});
  const auto log = instance->validationLog();
  const OpenedDevice opened = openDevice(*instance, {});
  const Device& device = *opened.device;
  const ComputePipeline fill(device, fillDescription());
  const Buffer buffer(
      device, 4000,
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
      MemoryKind::HostVisible);
  const Binding bindings[] = {buffer};
  const BindingSet set(device, fill, bindings);
  CommandList commands(device);
  commands.begin();
  commands.dispatch(fill, set, bytesOf(FillPush{5, 1000}), 16);
  commands.copy(buffer, 0, buffer, 2000, 400);
  commands.submitAndWait();
  VkBufferCreateInfo empty{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  empty.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  VkBuffer handle = VK_NULL_HANDLE;
  if (vkCreateBuffer(device.handle(), &empty, nullptr, &handle) == VK_SUCCESS)
    vkDestroyBuffer(device.handle(), handle, nullptr);
  std::string all;
  for (const std::string& message : log->messages()) all += message + "\n";
  CHECK(all.find("SYNC-HAZARD-WRITE-AFTER-WRITE") != std::string::npos);
  CHECK(all.find("VUID-VkBufferCreateInfo-size-00912") != std::string::npos);
}

TEST_CASE("an instance without validation does not disturb one with validation") {
  std::shared_ptr<ValidationLog> log;
  {
    const Instance validated({.validation = true});
    log = validated.validationLog();
    const Instance plain;
    CHECK_FALSE(plain.validationLog());
    CHECK(validated.physicalDevices().size() == plain.physicalDevices().size());
  }
  CHECK(log->messages().empty());
}

TEST_CASE("a queue family without graphics is preferred") {
  const auto family = [](VkQueueFlags flags) { return VkQueueFamilyProperties{flags, 1, 0, {}}; };
  const VkQueueFamilyProperties both = family(VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT),
                                compute = family(VK_QUEUE_COMPUTE_BIT), copies = family(VK_QUEUE_TRANSFER_BIT);
  CHECK(chooseComputeQueueFamily(std::vector{both, copies, compute, compute}) == 2);
  CHECK(chooseComputeQueueFamily(std::vector{copies, both, both}) == 1);
  CHECK_FALSE(chooseComputeQueueFamily(std::vector{copies}));
}

TEST_CASE("a buffer beyond the device's limits is an error that names the limit") {
  const test::ValidatedDevice device;
  DeviceFacts small = device->facts();
  if (small.maxMemoryAllocationSize == 0 || small.maxMemoryAllocationSize > (1ull << 50)) return;
  CHECK_THROWS_WITH_AS(
      Buffer(*device, small.maxMemoryAllocationSize + 1, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::DeviceLocal),
      doctest::Contains("allows"), Error);
}
