#include "pipeline/device_sharing.h"

#include <doctest/doctest.h>
#include <volk.h>

#include <atomic>
#include <barrier>
#include <memory>
#include <thread>
#include <vector>

#include "asdf_vk/session.h"
#include "generate/shapes.h"
#include "support/bits.h"
#include "support/fake_device.h"
#include "support/require_failure.h"
#include "support/shared_session.h"

using namespace asdfvk;
using test::FakeDevice;
using test::haveSameBits;
using test::ScopedVariable;
using test::tenthOfFaces;

namespace {

/// A GPU with memory of its own.
const FakeDevice::Variables kSharedGpu{{"ASDF_VK_FAKE_TYPE", "discrete"}, {"ASDF_VK_FAKE_SEPARATE_MEMORY", "1"},
                                       {"ASDF_VK_FAKE_VENDOR", "0x10de"}, {"ASDF_VK_FAKE_SUBGROUP_SIZE", "32"},
                                       {"ASDF_VK_FAKE_QUEUES", "2"},      {"ASDF_VK_GPU_RAYS", "1"}};
const SessionOptions kVulkan{.backend = BackendChoice::Vulkan};

/// Counts calls of all threads while it exists.
class SharedCallCounter {
 public:
  SharedCallCounter() {
    devices_ = allocations_ = submissions_ = 0;
    createDevice_ = vkCreateDevice, allocate_ = vkAllocateMemory, createPool_ = vkCreateDescriptorPool,
    createFence_ = vkCreateFence, submit_ = vkQueueSubmit;
    vkCreateDevice = [](VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                        const VkAllocationCallbacks* callbacks, VkDevice* device) {
      ++devices_;
      return createDevice_(physical, info, callbacks, device);
    };
    vkAllocateMemory = [](VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                          VkDeviceMemory* memory) {
      ++allocations_;
      return allocate_(device, info, callbacks, memory);
    };
    vkCreateDescriptorPool = [](VkDevice device, const VkDescriptorPoolCreateInfo* info,
                                const VkAllocationCallbacks* callbacks, VkDescriptorPool* pool) {
      ++allocations_;
      return createPool_(device, info, callbacks, pool);
    };
    vkCreateFence = [](VkDevice device, const VkFenceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                       VkFence* fence) {
      ++allocations_;
      return createFence_(device, info, callbacks, fence);
    };
    vkQueueSubmit = [](VkQueue queue, uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
      ++submissions_;
      return submit_(queue, count, infos, fence);
    };
  }
  ~SharedCallCounter() {
    vkCreateDevice = createDevice_, vkAllocateMemory = allocate_, vkCreateDescriptorPool = createPool_,
    vkCreateFence = createFence_, vkQueueSubmit = submit_;
  }
  SharedCallCounter(const SharedCallCounter&) = delete;
  SharedCallCounter& operator=(const SharedCallCounter&) = delete;

  [[nodiscard]] static uint32_t deviceCount() { return devices_; }
  [[nodiscard]] static uint32_t submissionCount() { return submissions_; }
  /// The number of allocations of memory, of descriptor pools and of fences.
  [[nodiscard]] static uint32_t allocationCount() { return allocations_; }

 private:
  static inline std::atomic<uint32_t> devices_, allocations_, submissions_;
  static inline PFN_vkCreateDevice createDevice_ = nullptr;
  static inline PFN_vkAllocateMemory allocate_ = nullptr;
  static inline PFN_vkCreateDescriptorPool createPool_ = nullptr;
  static inline PFN_vkCreateFence createFence_ = nullptr;
  static inline PFN_vkQueueSubmit submit_ = nullptr;
};

}  // namespace

TEST_CASE("threads that share a device compute the bits of a session alone, and allocate only for their first mesh") {
  const FakeDevice fake(kSharedGpu);
  const std::vector<Mesh> meshes{makeTorus(20'000).mesh, makeAnimal(19'000).mesh, makeAnimal(5000).mesh};
  std::vector<std::vector<double>> expected;
  {
    Session alone(kVulkan);
    for (const Mesh& mesh : meshes) expected.push_back(alone.compute(mesh, tenthOfFaces()).sdf());
  }
  constexpr uint32_t kThreadCount = 3;
  const std::unique_ptr<DeviceSharing> sharing = DeviceSharing::ofGpu(kVulkan, kThreadCount);
  REQUIRE(sharing);
  std::vector<std::unique_ptr<Session>> sessions;
  for (uint32_t i = 0; i < kThreadCount; ++i) sessions.push_back(std::make_unique<Session>(kVulkan));
  const SharedCallCounter counter;
  uint32_t afterFirst = 0;
  std::barrier firstIsDone(kThreadCount, [&]() noexcept { afterFirst = SharedCallCounter::allocationCount(); });
  std::atomic<uint32_t> sameCount = 0;
  {
    std::vector<std::jthread> threads;
    for (const std::unique_ptr<Session>& session : sessions)
      threads.emplace_back([&, own = session.get()] {
        const auto compute = [&](size_t mesh) {
          sameCount += haveSameBits(own->compute(meshes[mesh], tenthOfFaces()).sdf(), expected[mesh]) ? 1 : 0;
        };
        compute(0);
        firstIsDone.arrive_and_wait();
        for (const size_t mesh : {1, 2, 0, 1}) compute(mesh);
      });
  }
  CHECK(sameCount == 5 * kThreadCount);
  CHECK(afterFirst > 0);
  CHECK(SharedCallCounter::allocationCount() == afterFirst);
}

TEST_CASE("sessions with the same options share one device, whose kernels are checked once") {
  const FakeDevice fake(kSharedGpu);
  const std::unique_ptr<DeviceSharing> sharing = DeviceSharing::ofGpu(kVulkan, 2);
  REQUIRE(sharing);
  const SharedCallCounter counter;
  const Mesh mesh = makeTorus(1000).mesh;
  Session first(kVulkan), second(kVulkan);
  const auto submissionsOf = [&](Session& session) {
    const uint32_t before = SharedCallCounter::submissionCount();
    (void)session.compute(mesh, tenthOfFaces());
    return SharedCallCounter::submissionCount() - before;
  };
  const uint32_t withChecks = submissionsOf(first), without = submissionsOf(second);
  CHECK(without < withChecks);
  CHECK(submissionsOf(first) == without);
  CHECK(second.deviceLines() == first.deviceLines());
  CHECK(SharedCallCounter::deviceCount() == 1);
}

TEST_CASE("a lost device is lost for all sessions that share it; the next session opens it again") {
  const FakeDevice fake(kSharedGpu);
  const std::unique_ptr<DeviceSharing> sharing = DeviceSharing::ofGpu(kVulkan, 2);
  REQUIRE(sharing);
  const SharedCallCounter counter;
  const Mesh mesh = makeTorus(1000).mesh;
  Session first(kVulkan), second(kVulkan);
  const std::vector<double> expected = second.compute(mesh, tenthOfFaces()).sdf();
  {
    const ScopedVariable lost("ASDF_VK_FAKE_LOST_AT", "1");
    test::requireFailure([&] { (void)first.compute(mesh, tenthOfFaces()); }, ErrorCode::DeviceLost);
  }
  test::requireFailure([&] { (void)second.compute(mesh, tenthOfFaces()); }, ErrorCode::DeviceLost);
  Session third(kVulkan), fourth(kVulkan);
  CHECK(haveSameBits(third.compute(mesh, tenthOfFaces()).sdf(), expected));
  CHECK(haveSameBits(fourth.compute(mesh, tenthOfFaces()).sdf(), expected));
  CHECK(SharedCallCounter::deviceCount() == 2);
}

TEST_CASE("sessions with other options, or after the lifetime of the object, have a device of their own") {
  const FakeDevice fake(kSharedGpu);
  const Mesh mesh = makeTorus(1000).mesh;
  const auto lose = [&](Session& session) {
    const ScopedVariable lost("ASDF_VK_FAKE_LOST_AT", "1");
    test::requireFailure([&] { (void)session.compute(mesh, tenthOfFaces()); }, ErrorCode::DeviceLost);
  };
  std::unique_ptr<DeviceSharing> sharing = DeviceSharing::ofGpu(kVulkan, 2);
  REQUIRE(sharing);
  Session first(kVulkan), other({.backend = BackendChoice::Vulkan, .device = "0"});
  lose(other);
  CHECK_NOTHROW((void)first.compute(mesh, tenthOfFaces()));
  sharing.reset();
  Session after(kVulkan);
  lose(after);
  CHECK_NOTHROW((void)first.compute(mesh, tenthOfFaces()));
}

TEST_CASE("only a GPU is shared") {
  const FakeDevice fake(kSharedGpu);
  CHECK(DeviceSharing::ofGpu({}, 2));
  for (const BackendChoice backend : {BackendChoice::Cpu, BackendChoice::Reference})
    CHECK_FALSE(DeviceSharing::ofGpu({.backend = backend}, 2));
  CHECK_FALSE(DeviceSharing::ofGpu({.device = "no such device"}, 2));
  {
    const ScopedVariable cpu("ASDF_VK_FAKE_TYPE", "cpu");
    CHECK_FALSE(DeviceSharing::ofGpu({}, 2));
    CHECK_FALSE(DeviceSharing::ofGpu(kVulkan, 2));
  }
  {
    const ScopedVariable files("VK_DRIVER_FILES", "/nonexistent"), names("VK_ICD_FILENAMES", "/nonexistent");
    CHECK_FALSE(DeviceSharing::ofGpu({}, 2));
  }
}
