#include <doctest/doctest.h>
#include <volk.h>

#include <algorithm>
#include <unordered_map>

#include "asdf_vk/session.h"
#include "generate/shapes.h"
#include "support/fake_device.h"
#include "support/shared_session.h"

using namespace asdfvk;

namespace {

/// Memory of buffers that exist at the same time, on a device with separate memory that is open when this is made.
class MemoryPeaks {
 public:
  MemoryPeaks() {
    heapOf_.clear(), buffers_.clear();
    std::ranges::fill(used_, 0), std::ranges::fill(peak_, 0);
    allocate_ = vkAllocateMemory, create_ = vkCreateBuffer, bind_ = vkBindBufferMemory, destroy_ = vkDestroyBuffer;
    vkAllocateMemory = [](VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                          VkDeviceMemory* memory) {
      const VkResult result = allocate_(device, info, callbacks, memory);
      heapOf_[*memory] = info->memoryTypeIndex == 0 ? Heap::Device : Heap::Host;
      return result;
    };
    vkCreateBuffer = [](VkDevice device, const VkBufferCreateInfo* info, const VkAllocationCallbacks* callbacks,
                        VkBuffer* buffer) {
      const VkResult result = create_(device, info, callbacks, buffer);
      buffers_[*buffer] = {info->size, Heap::Host};
      return result;
    };
    vkBindBufferMemory = [](VkDevice device, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset) {
      auto& [byteCount, heap] = buffers_[buffer];
      heap = heapOf_.at(memory);
      used_[heap] += byteCount;
      peak_[heap] = std::max(peak_[heap], used_[heap]);
      return bind_(device, buffer, memory, offset);
    };
    vkDestroyBuffer = [](VkDevice device, VkBuffer buffer, const VkAllocationCallbacks* callbacks) {
      if (const auto found = buffers_.find(buffer); found != buffers_.end()) {
        used_[found->second.heap] -= found->second.byteCount;
        buffers_.erase(found);
      }
      destroy_(device, buffer, callbacks);
    };
  }
  ~MemoryPeaks() {
    vkAllocateMemory = allocate_, vkCreateBuffer = create_, vkBindBufferMemory = bind_, vkDestroyBuffer = destroy_;
  }
  MemoryPeaks(const MemoryPeaks&) = delete;
  MemoryPeaks& operator=(const MemoryPeaks&) = delete;

  enum Heap { Device, Host };
  /// The greatest memory of buffers in bytes.
  [[nodiscard]] double of(Heap heap) const { return static_cast<double>(peak_[heap]); }
  /// Begins again with the buffers that exist now.
  void restart() { std::ranges::copy(used_, peak_); }

 private:
  struct Entry {
    uint64_t byteCount = 0;
    Heap heap = Host;
  };
  static inline std::unordered_map<VkDeviceMemory, Heap> heapOf_;
  static inline std::unordered_map<VkBuffer, Entry> buffers_;
  static inline uint64_t used_[2], peak_[2];
  static inline PFN_vkAllocateMemory allocate_ = nullptr;
  static inline PFN_vkCreateBuffer create_ = nullptr;
  static inline PFN_vkBindBufferMemory bind_ = nullptr;
  static inline PFN_vkDestroyBuffer destroy_ = nullptr;
};

}  // namespace

TEST_CASE("the memory of a GPU per face and per seed is that of docs/devices.md") {
  const test::FakeDevice fake({{"ASDF_VK_FAKE_TYPE", "discrete"}, {"ASDF_VK_FAKE_SEPARATE_MEMORY", "1"}});
  Session session({.backend = BackendChoice::Vulkan});
  MemoryPeaks peaks;
  const auto check = [&](const Mesh& mesh, const Options& options, const auto& documented) {
    peaks.restart();
    const auto seedCount = static_cast<double>(session.compute(mesh, options).report.seedCount);
    const auto faceCount = static_cast<double>(mesh.faces.size());
    MESSAGE(faceCount, " faces, ", seedCount, " seeds, bytes per face: ", peaks.of(MemoryPeaks::Device) / faceCount,
            " on the device, ", peaks.of(MemoryPeaks::Host) / faceCount, " on the host");
    const double expected = documented(faceCount, seedCount);
    CHECK(peaks.of(MemoryPeaks::Device) <= expected);
    CHECK(peaks.of(MemoryPeaks::Device) >= 0.8 * expected);
    CHECK(peaks.of(MemoryPeaks::Host) <= 70 * faceCount);
  };
  // One chunk of cones, so that the speed of the device has no influence.
  check(makeAnimal(30'000).mesh, test::allSeeds(),
        [](double faceCount, double) { return 56 * faceCount + 172 * 32'768; });
  check(makeAnimal(100'000).mesh, test::tenthOfFaces(),
        [](double faceCount, double seedCount) { return (56 + 36 + 8) * faceCount + (240 + 1040) * seedCount; });
}
