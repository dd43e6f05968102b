#include "vk/memory_types.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace asdfvk;

namespace {

constexpr VkMemoryPropertyFlags kMapped = kMappableMemory, kIsLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                kIsCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
                                kOfAmd = VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD;
constexpr uint64_t kMiB = 1u << 20, kGiB = 1u << 30;

/// Memory of a device, and the type that buffers of each kind are in.
struct MemoryRow {
  std::string device;
  std::vector<uint64_t> heaps;
  std::vector<VkMemoryType> types;
  uint32_t deviceLocal, uploaded, hostVisible;

  [[nodiscard]] VkPhysicalDeviceMemoryProperties memory() const {
    VkPhysicalDeviceMemoryProperties memory{};
    for (const uint64_t byteCount : heaps) memory.memoryHeaps[memory.memoryHeapCount++].size = byteCount;
    for (const VkMemoryType& type : types) memory.memoryTypes[memory.memoryTypeCount++] = type;
    return memory;
  }
};

/// The types as drivers report them.
const std::vector<MemoryRow> kRows{
    {"NVIDIA, window",
     {24 * kGiB, 48 * kGiB, 246 * kMiB},
     {{0, 1}, {kIsLocal, 0}, {kMapped, 1}, {kMapped | kIsCached, 1}, {kIsLocal | kMapped, 2}},
     1,
     1,
     3},
    {"NVIDIA, resizable BAR",
     {24 * kGiB, 48 * kGiB},
     {{0, 1}, {kIsLocal, 0}, {kMapped, 1}, {kMapped | kIsCached, 1}, {kIsLocal | kMapped, 0}},
     1,
     4,
     3},
    {"AMD, window",
     {7 * kGiB, 16 * kGiB, 256 * kMiB},
     {{kIsLocal, 0}, {kMapped, 1}, {kIsLocal | kMapped, 2}, {kMapped | kIsCached, 1}, {kIsLocal | kOfAmd, 0}},
     0,
     0,
     3},
    {"AMD, resizable BAR",
     {16 * kGiB, 16 * kGiB},
     {{kIsLocal, 1}, {kMapped, 0}, {kIsLocal | kMapped | kOfAmd, 1}, {kIsLocal | kMapped, 1}, {kMapped | kIsCached, 0}},
     0,
     3,
     4},
    {"AMD, integrated",
     {5 * kGiB, 10 * kGiB},
     {{kMapped, 0}, {kIsLocal | kMapped, 1}, {kMapped | kIsCached, 0}},
     1,
     1,
     2},
    {"Intel, integrated",
     {12 * kGiB},
     {{kIsLocal, 0}, {kIsLocal | kMapped, 0}, {kIsLocal | kMapped | kIsCached, 0}},
     2,
     2,
     2},
    {"lavapipe", {12 * kGiB}, {{kIsLocal | kMapped | kIsCached, 0}}, 0, 0, 0},
};

}  // namespace

TEST_CASE("each kind of memory is the best type of the devices of each vendor") {
  for (const MemoryRow& row : kRows) {
    CAPTURE(row.device);
    const VkPhysicalDeviceMemoryProperties memory = row.memory();
    const auto firstOf = [&](MemoryKind kind, uint64_t byteCount) {
      return rankMemoryTypes(memory, ~0u, kind, byteCount).front();
    };
    for (const uint64_t byteCount : {uint64_t{16}, 64 * kMiB}) {
      CHECK(firstOf(MemoryKind::DeviceLocal, byteCount) == row.deviceLocal);
      CHECK(firstOf(MemoryKind::DeviceOnly, byteCount) == row.deviceLocal);
      CHECK(firstOf(MemoryKind::Uploaded, byteCount) == row.uploaded);
      CHECK(firstOf(MemoryKind::HostVisible, byteCount) == row.hostVisible);
    }
    CHECK(firstOf(MemoryKind::Uploaded, 100 * kGiB) == row.deviceLocal);  // Too much of any heap.
  }
}

TEST_CASE("every allowed type is ranked once, and special ones never") {
  for (const MemoryRow& row : kRows)
    for (const MemoryKind kind : {MemoryKind::DeviceLocal, MemoryKind::Uploaded, MemoryKind::HostVisible}) {
      CAPTURE(row.device);
      std::vector<uint32_t> expected;
      constexpr uint32_t kAllowed = ~2u;
      for (uint32_t type = 0; type < row.types.size(); ++type) {
        const VkMemoryPropertyFlags flags = row.types[type].propertyFlags;
        const bool isOfKind = kind != MemoryKind::HostVisible || (flags & kMapped) == kMapped;
        if ((kAllowed >> type & 1) != 0 && (flags & kOfAmd) == 0 && isOfKind) expected.push_back(type);
      }
      std::vector<uint32_t> ranked = rankMemoryTypes(row.memory(), kAllowed, kind, 16);
      std::ranges::sort(ranked);
      CHECK(ranked == expected);
    }
}
