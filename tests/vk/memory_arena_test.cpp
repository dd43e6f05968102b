#include "vk/memory_arena.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/random.h"
#include "core/stopwatch.h"
#include "support/counted_memory.h"
#include "support/require_failure.h"
#include "support/test_device.h"
#include "vk/command_list.h"
#include "vk/shared_buffer.h"

using namespace asdfvk;

namespace {

constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr VkBufferUsageFlags kTransfer = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

std::vector<uint32_t> numbers(size_t count) {
  std::vector<uint32_t> words(count);
  std::iota(words.begin(), words.end(), 3u);
  return words;
}

}  // namespace

TEST_CASE("buffers have ranges of their own, and later buffers use the ranges again") {
  const auto gpu = test::ValidatedDevice::changed([](DeviceFacts& facts) { facts.kind = DeviceKind::Discrete; });
  const Device& device = *gpu;
  const test::CountedMemory counted;
  Random random(4);
  std::vector<std::pair<Buffer, uint32_t>> buffers;  // With the word that fills the buffer.
  const auto check = [](const std::pair<Buffer, uint32_t>& buffer) {
    const std::span<const uint32_t> words = buffer.first.mappedAs<const uint32_t>();
    return std::all_of(words.begin(), words.end(), [&](uint32_t word) { return word == buffer.second; });
  };
  for (uint32_t step = 0; step < 2000; ++step) {
    if (buffers.size() < 40 || random.index(2) == 0) {
      Buffer buffer(device, 4 + 4 * random.index(20'000), kStorage, MemoryKind::HostVisible);
      std::ranges::fill(buffer.mappedAs<uint32_t>(), step);
      buffers.emplace_back(std::move(buffer), step);
    } else {
      const auto removed = buffers.begin() + static_cast<std::ptrdiff_t>(random.index(buffers.size()));
      REQUIRE(check(*removed));
      buffers.erase(removed);
    }
  }
  CHECK(std::all_of(buffers.begin(), buffers.end(), check));
  CHECK(counted.allocationCount() <= 4);
  CHECK(device.memory().idleByteCount() == 0);
  buffers.clear();
  CHECK(device.memory().idleByteCount() > 0);
  device.memory().clear();
  CHECK(device.memory().idleByteCount() == 0);
}

TEST_CASE("idle blocks are bounded: few on a CPU device, whose memory is that of the process") {
  const auto idleAfter = [](const Device& device, uint64_t byteCount) {
    {
      std::vector<Buffer> buffers;
      for (int i = 0; i < 6; ++i) buffers.emplace_back(device, byteCount, kStorage, MemoryKind::DeviceOnly);
    }
    return device.memory().idleByteCount();
  };
  const auto cpu = test::ValidatedDevice::changed([](DeviceFacts& facts) { facts.kind = DeviceKind::Cpu; });
  CHECK(idleAfter(*cpu, 3 << 20) == 15 << 20);
  const auto gpu = test::ValidatedDevice::changed([](DeviceFacts& facts) { facts.kind = DeviceKind::Discrete; });
  const uint64_t idle = idleAfter(*gpu, 200 << 20);
  CHECK(idle <= MemoryArena::kMaxIdleByteCount);
  CHECK(idle >= uint64_t{400} << 20);
}

TEST_CASE("idle blocks are freed before a device counts as out of memory") {
  const test::ValidatedDevice device;
  static PFN_vkAllocateMemory allocate;
  static const MemoryArena* memory;
  allocate = vkAllocateMemory;
  memory = &device->memory();
  { const Buffer idle(*device, 1000, kStorage, MemoryKind::DeviceLocal); }
  REQUIRE(memory->idleByteCount() > 0);
  vkAllocateMemory = [](VkDevice handle, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                        VkDeviceMemory* given) -> VkResult {
    if (memory->idleByteCount() > 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return allocate(handle, info, callbacks, given);
  };
  CHECK_NOTHROW(Buffer(*device, 5 << 20, kStorage, MemoryKind::DeviceLocal));
  vkAllocateMemory = [](VkDevice, const VkMemoryAllocateInfo*, const VkAllocationCallbacks*,
                        VkDeviceMemory*) -> VkResult { return VK_ERROR_OUT_OF_DEVICE_MEMORY; };
  test::requireFailure([&] { Buffer(*device, 50 << 20, kStorage, MemoryKind::DeviceLocal); },
                       ErrorCode::OutOfDeviceMemory, "out of device memory");
  vkAllocateMemory = allocate;
}

TEST_CASE("the time of submissions is that of the device, by kind, and less than that of the host") {
  const test::ValidatedDevice device;
  REQUIRE(device->facts().timestampBits > 0);  // llvmpipe has timestamps.
  const Buffer from(*device, 64 << 20, kTransfer, MemoryKind::DeviceLocal),
      to(*device, 64 << 20, kTransfer, MemoryKind::DeviceLocal);
  const Stopwatch watch;
  CommandList commands(*device);
  for (int i = 0; i < 3; ++i) {
    commands.begin();
    commands.copy(from, 0, to, 0, from.byteCount());
    commands.barrier();
    commands.submitAndWait();
  }
  const double wall = watch.seconds();
  CHECK(device->seconds().copies > 0);
  CHECK(device->seconds().copies <= wall);
  CHECK(device->seconds().kernels == 0);
}

TEST_CASE("copies in pieces are exact for all sizes, and use their memory again") {
  const auto separate = test::ValidatedDevice::changed([](DeviceFacts& facts) {
    test::useSeparateMemory(facts);
    facts.kind = DeviceKind::Discrete;  // Keeps idle memory.
  });
  const Device& device = *separate;
  constexpr uint64_t kPiece = kMaxPieceByteCount;
  const std::vector<uint32_t> all = numbers((3 * kPiece + 20) / 4);
  const auto checkCopy = [&](uint64_t byteCount) {
    const std::vector<uint32_t> words(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(byteCount / 4));
    const Buffer buffer = uploadBuffer(device, std::as_bytes(std::span(words)), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    REQUIRE(buffer.mapped() == nullptr);
    std::vector<uint32_t> back(words.size());
    downloadBuffer(device, buffer, std::as_writable_bytes(std::span(back)));
    CHECK(back == words);
  };
  for (const uint64_t byteCount :
       {uint64_t{0}, uint64_t{4}, kPiece - 4, kPiece, kPiece + 4, 2 * kPiece, 3 * kPiece + 20})
    checkCopy(byteCount);
  const test::CountedMemory counted;
  checkCopy(3 * kPiece + 20);
  checkCopy(4);
  CHECK(counted.allocationCount() <= 1);  // For staging memory, if an earlier upload has not ended.
}

TEST_CASE("items are written once, directly or in pieces of whole items, and read back") {
  struct Item {
    uint32_t index, square, none;  // 12 bytes, which do not divide a piece.
  };
  const auto check = [](const Device& device) {
    for (const size_t count : {size_t{0}, size_t{1}, size_t{1000}, size_t{2 * kMaxPieceByteCount / sizeof(Item) + 7}}) {
      std::vector<uint8_t> timesWritten(count, 0);
      const Buffer buffer =
          uploadItems<Item>(device, count, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, [&](size_t first, std::span<Item> items) {
            for (size_t i = 0; i < items.size(); ++i) {
              const auto index = static_cast<uint32_t>(first + i);
              items[i] = {index, index * index, 0};
              ++timesWritten[index];
            }
          });
      std::vector<Item> items(count);
      downloadBuffer(device, buffer, std::as_writable_bytes(std::span(items)));
      size_t wrongCount = 0;
      for (uint32_t i = 0; i < count; ++i)
        wrongCount += timesWritten[i] == 1 && items[i].index == i && items[i].square == i * i ? 0 : 1;
      CHECK(wrongCount == 0);
    }
  };
  check(*test::ValidatedDevice());
  check(*test::ValidatedDevice::changed(test::useSeparateMemory));
}

TEST_CASE("a shared buffer transfers in its direction on devices with and without memory of their own") {
  const auto check = [](const Device& device) {
    const std::vector<uint32_t> words = numbers(1000);
    SharedBuffer input(device, 4000, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, SharedBuffer::Host::Writes);
    SharedBuffer output(device, 4000, VK_BUFFER_USAGE_TRANSFER_DST_BIT, SharedBuffer::Host::Reads);
    std::copy(words.begin(), words.end(), input.onHost<uint32_t>().begin());
    CommandList commands(device);
    commands.begin();
    input.recordCopy(commands, 4000);
    commands.barrier();
    commands.copy(input.onDevice(), 0, output.onDevice(), 0, 4000);
    commands.barrier();
    output.recordCopy(commands, 4000);
    commands.barrier();
    commands.submit();
    commands.wait();
    const std::span<const uint32_t> seen = output.onHost<uint32_t>();
    CHECK(std::vector(seen.begin(), seen.begin() + 1000) == words);
  };
  const test::ValidatedDevice mapped;
  check(*mapped);
  const auto separate = test::ValidatedDevice::changed(test::useSeparateMemory);
  check(*separate);
}
