#include <doctest/doctest.h>
#include <volk.h>

#include <numeric>

#include "asdf_vk/session.h"
#include "generate/shapes.h"
#include "support/fake_device.h"
#include "support/shared_session.h"

using namespace asdfvk;
using test::FakeDevice;

namespace {

/// A GPU with memory of its own.
const FakeDevice::Variables kCountedGpu{{"ASDF_VK_FAKE_TYPE", "discrete"},
                                        {"ASDF_VK_FAKE_SEPARATE_MEMORY", "1"},
                                        {"ASDF_VK_FAKE_VENDOR", "0x10de"},
                                        {"ASDF_VK_FAKE_SUBGROUP_SIZE", "32"}};

struct CallCounts {
  uint32_t allocations = 0, descriptorPools = 0, fences = 0, waits = 0, submissions = 0;
};

/// Counts calls of all devices while it exists.
class CallCounter {
 public:
  CallCounter() {
    counts_ = {};
    allocate_ = vkAllocateMemory, createPool_ = vkCreateDescriptorPool, createFence_ = vkCreateFence;
    wait_ = vkWaitForFences, submit_ = vkQueueSubmit;
    vkAllocateMemory = [](VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                          VkDeviceMemory* memory) {
      ++counts_.allocations;
      return allocate_(device, info, callbacks, memory);
    };
    vkCreateDescriptorPool = [](VkDevice device, const VkDescriptorPoolCreateInfo* info,
                                const VkAllocationCallbacks* callbacks, VkDescriptorPool* pool) {
      ++counts_.descriptorPools;
      return createPool_(device, info, callbacks, pool);
    };
    vkCreateFence = [](VkDevice device, const VkFenceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                       VkFence* fence) {
      ++counts_.fences;
      return createFence_(device, info, callbacks, fence);
    };
    vkWaitForFences = [](VkDevice device, uint32_t count, const VkFence* fences, VkBool32 all, uint64_t timeout) {
      ++counts_.waits;
      return wait_(device, count, fences, all, timeout);
    };
    vkQueueSubmit = [](VkQueue queue, uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
      ++counts_.submissions;
      return submit_(queue, count, infos, fence);
    };
  }
  ~CallCounter() {
    vkAllocateMemory = allocate_, vkCreateDescriptorPool = createPool_, vkCreateFence = createFence_;
    vkWaitForFences = wait_, vkQueueSubmit = submit_;
  }
  CallCounter(const CallCounter&) = delete;
  CallCounter& operator=(const CallCounter&) = delete;

  [[nodiscard]] const CallCounts& counts() const { return counts_; }

 private:
  static inline CallCounts counts_;
  static inline PFN_vkAllocateMemory allocate_ = nullptr;
  static inline PFN_vkCreateDescriptorPool createPool_ = nullptr;
  static inline PFN_vkCreateFence createFence_ = nullptr;
  static inline PFN_vkWaitForFences wait_ = nullptr;
  static inline PFN_vkQueueSubmit submit_ = nullptr;
};

CallCounts countsOf(Session& session, const Mesh& mesh, const Options& options) {
  const CallCounter counter;
  (void)session.compute(mesh, options);
  return counter.counts();
}

}  // namespace

TEST_CASE("from the second mesh on, a GPU allocates nothing; the host waits for it a few times") {
  const FakeDevice fake(kCountedGpu);
  Session session({.backend = BackendChoice::Vulkan});
  const Mesh first = makeTorus(20'000).mesh, second = makeAnimal(19'000).mesh, third = makeAnimal(5000).mesh;
  for (const bool hasAllSeeds : {false, true}) {
    const Options options = hasAllSeeds ? test::allSeeds() : test::tenthOfFaces();
    (void)session.compute(first, options);
    for (const Mesh* mesh : {&second, &third, &first}) {
      const CallCounts counts = countsOf(session, *mesh, options);
      CAPTURE(hasAllSeeds);
      CAPTURE(mesh->faces.size());
      MESSAGE(counts.submissions, " submissions, ", counts.waits, " waits");
      CHECK(counts.allocations == 0);
      CHECK(counts.descriptorPools == 0);
      CHECK(counts.fences == 0);
      CHECK(counts.waits <= (hasAllSeeds ? 4 : 10));
    }
  }
}

TEST_CASE("the times of the device are those of its kernels and copies, and less than the time of the stages") {
  const FakeDevice fake(kCountedGpu);
  Session session({.backend = BackendChoice::Vulkan});
  const auto sumOf = [](const StageSeconds& seconds) {
    return std::accumulate(seconds.seconds.begin(), seconds.seconds.end(), 0.0);
  };
  for (int run = 0; run < 2; ++run) {
    const Report report = session.compute(makeTorus(20'000).mesh, test::tenthOfFaces()).report;
    REQUIRE(report.deviceTimes);
    for (const Stage stage : {Stage::Trace, Stage::Predict, Stage::Solve}) {
      CHECK(report.deviceTimes->kernels[stage] > 0);
      CHECK(report.deviceTimes->copies[stage] > 0);
    }
    CHECK(report.deviceTimes->raysPerSecond > 0);
    CHECK(sumOf(report.deviceTimes->kernels) + sumOf(report.deviceTimes->copies) < sumOf(report.stageSeconds));
  }
  Session cpu({.backend = BackendChoice::Cpu});
  CHECK_FALSE(cpu.compute(makeTorus(1000).mesh, test::tenthOfFaces()).report.deviceTimes);
}
