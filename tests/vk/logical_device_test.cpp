#include "vk/logical_device.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

#include "asdf_vk/error.h"
#include "shared/specialization_ids.h"
#include "spirv/fill.comp.h"
#include "support/fake_device.h"
#include "support/require_failure.h"
#include "vk/buffer.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

using namespace asdfvk;
using test::FakeDevice;
using test::requireFailure;
using test::ScopedVariable;

namespace {

/// A GPU with three queues and memory of its own.
const FakeDevice::Variables kQueues{
    {"ASDF_VK_FAKE_TYPE", "discrete"}, {"ASDF_VK_FAKE_SEPARATE_MEMORY", "1"}, {"ASDF_VK_FAKE_QUEUES", "3"}};

constexpr uint32_t kWordCount = 10'000;

/// Words that a kernel on this device wrote: `value` and the numbers that follow.
std::vector<uint32_t> filledBy(const Device& device, uint32_t value) {
  struct Push {
    uint32_t value, wordCount;
  };
  const ComputePipeline fill(
      device, {"fill.comp", k_fill_comp, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}, sizeof(Push), {{kLocalSizeXId, 64}}});
  const std::vector<uint32_t> zeros(kWordCount);
  const Buffer buffer = uploadBuffer(device, std::as_bytes(std::span(zeros)),
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  const Binding bindings[] = {buffer};
  const BindingSet set(device, fill, bindings);
  CommandList commands(device);
  commands.begin();
  commands.dispatch(fill, set, bytesOf(Push{value, kWordCount}), (kWordCount + 63) / 64);
  commands.barrier();
  commands.submitAndWait();
  std::vector<uint32_t> words(kWordCount);
  downloadBuffer(device, buffer, std::as_writable_bytes(std::span(words)));
  return words;
}

}  // namespace

TEST_CASE("threads use a logical device at the same time, each with a device, on fewer queues than threads") {
  const FakeDevice fake(kQueues);
  const Instance instance;
  for (const uint32_t queueCount : {1U, 2U, 8U}) {
    const OpenedLogicalDevice opened = openLogicalDevice(instance, {}, queueCount);
    std::atomic<uint32_t> rightCount = 0;
    std::vector<std::jthread> threads;
    for (uint32_t thread = 0; thread < 4; ++thread)
      threads.emplace_back([&, thread] {
        const Device device(opened.device);
        for (uint32_t i = 0; i < 20; ++i) {
          std::vector<uint32_t> expected(kWordCount);
          std::iota(expected.begin(), expected.end(), 1 + 100 * thread + i);
          rightCount += filledBy(device, expected.front()) == expected ? 1 : 0;
        }
      });
    threads.clear();
    CHECK(rightCount == 80);
  }
}

TEST_CASE("a logical device has as many queues as are requested and exist, and gives them in turn") {
  const FakeDevice fake(kQueues);
  const Instance instance;
  for (const uint32_t requested : {0U, 1U, 2U, 3U, 8U}) {
    const OpenedLogicalDevice opened = openLogicalDevice(instance, {}, requested);
    const uint32_t count = std::clamp(requested, 1U, 3U);
    std::vector<LogicalDevice::Queue*> queues;
    for (uint32_t i = 0; i < 2 * count; ++i) queues.push_back(&opened.device->nextQueue());
    for (uint32_t i = 0; i < count; ++i) {
      CHECK(queues[i] == queues[i + count]);
      CHECK(std::count(queues.begin(), queues.end(), queues[i]) == 2);
    }
  }
}

TEST_CASE("a logical device is lost for all its devices") {
  const FakeDevice fake(kQueues);
  const Instance instance;
  const OpenedLogicalDevice opened = openLogicalDevice(instance, {}, 2);
  const Device first(opened.device), second(opened.device);
  CHECK(filledBy(first, 7).front() == 7);
  CHECK_FALSE(opened.device->isLost());
  {
    const ScopedVariable lost("ASDF_VK_FAKE_LOST_AT", "1");
    requireFailure([&] { (void)filledBy(second, 7); }, ErrorCode::DeviceLost);
  }
  CHECK(opened.device->isLost());
  requireFailure([&] { (void)filledBy(first, 7); }, ErrorCode::DeviceLost);
}
