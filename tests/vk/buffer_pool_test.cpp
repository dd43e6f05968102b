#include "vk/buffer_pool.h"

#include <doctest/doctest.h>

#include <numeric>
#include <vector>

#include "support/counted_memory.h"
#include "support/require_failure.h"
#include "support/test_device.h"
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

TEST_CASE("a buffer of the pool serves later users with the same usage and kind, the smallest that suffices") {
  const test::ValidatedDevice device;
  const auto take = [&](uint64_t byteCount, VkBufferUsageFlags usage = kStorage,
                        MemoryKind kind = MemoryKind::DeviceLocal) {
    return PooledBuffer(*device, byteCount, usage, kind);
  };
  VkBuffer small = VK_NULL_HANDLE, large = VK_NULL_HANDLE;
  {
    const PooledBuffer a = take(1000), b = take(4000);
    small = a->handle();
    large = b->handle();
    CHECK(device->pool().idleByteCount() == 0);
  }
  CHECK(device->pool().idleByteCount() == 5000);
  {
    const PooledBuffer other = take(500, kTransfer), kind = take(500, kStorage, MemoryKind::DeviceOnly);
    const PooledBuffer a = take(500), b = take(500), c = take(500);
    CHECK(a->handle() == small);
    CHECK(b->handle() == large);
    CHECK(c->handle() != other->handle());
    CHECK(c->handle() != kind->handle());
    CHECK(c->byteCount() == 500);
  }
  device->pool().clear();
  CHECK(device->pool().idleByteCount() == 0);
}

TEST_CASE("the pool keeps a bounded number of bytes") {
  const test::ValidatedDevice device;
  constexpr uint64_t kByteCount = BufferPool::kMaxIdleByteCount / 4 + 1;
  {
    std::vector<PooledBuffer> buffers;
    for (int i = 0; i < 6; ++i) buffers.emplace_back(*device, kByteCount, kStorage, MemoryKind::DeviceOnly);
  }
  CHECK(device->pool().idleByteCount() == 3 * kByteCount);
}

TEST_CASE("idle buffers are freed before a device counts as out of memory") {
  const test::ValidatedDevice device;
  static PFN_vkAllocateMemory allocate;
  static const BufferPool* pool;
  allocate = vkAllocateMemory;
  pool = &device->pool();
  { const PooledBuffer idle(*device, 1000, kStorage, MemoryKind::DeviceLocal); }
  vkAllocateMemory = [](VkDevice handle, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                        VkDeviceMemory* memory) -> VkResult {
    if (pool->idleByteCount() > 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return allocate(handle, info, callbacks, memory);
  };
  CHECK_NOTHROW(Buffer(*device, 5000, kStorage, MemoryKind::DeviceLocal));
  vkAllocateMemory = [](VkDevice, const VkMemoryAllocateInfo*, const VkAllocationCallbacks*,
                        VkDeviceMemory*) -> VkResult { return VK_ERROR_OUT_OF_DEVICE_MEMORY; };
  test::requireFailure([&] { Buffer(*device, 5000, kStorage, MemoryKind::DeviceLocal); }, ErrorCode::OutOfDeviceMemory,
                       "out of device memory");
  vkAllocateMemory = allocate;
}

TEST_CASE("copies in pieces are exact for all sizes, and the pool keeps their memory") {
  const auto separate = test::ValidatedDevice::changed(test::useSeparateMemory);
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
  CHECK(counted.allocationCount() == 2);  // The buffers themselves.
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
      UnsetVector<Item> copy;
      const std::span<const Item> items = readItems(device, buffer, count, copy);
      REQUIRE(items.size() == count);
      CHECK(copy.size() == (buffer.mapped() != nullptr && buffer.isCached() ? 0 : count));
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
