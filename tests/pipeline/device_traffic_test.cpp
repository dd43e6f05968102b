#include <doctest/doctest.h>
#include <volk.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "asdf_vk/session.h"
#include "generate/shapes.h"
#include "support/bits.h"
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
  uint64_t bytesUp = 0, bytesDown = 0;  ///< Copies from and to memory that the host maps.
};

/// Counts calls of a device that is open when it is made, and copies between buffers that are made later. The device
/// seems as slow as possible, so that the counts do not depend on its speed: a submission ends when the host waits for
/// it or for a later one.
class CallCounter {
 public:
  CallCounter() {
    counts_ = {};
    usages_.clear();
    submissionOf_.clear();
    submittedCount_ = endedCount_ = 0;
    allocate_ = vkAllocateMemory, createPool_ = vkCreateDescriptorPool, createFence_ = vkCreateFence;
    wait_ = vkWaitForFences, submit_ = vkQueueSubmit, createBuffer_ = vkCreateBuffer, copy_ = vkCmdCopyBuffer;
    getStatus_ = vkGetFenceStatus;
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
      for (const VkFence fence : std::span(fences, count)) endedCount_ = std::max(endedCount_, submissionOf_[fence]);
      return wait_(device, count, fences, all, timeout);
    };
    vkQueueSubmit = [](VkQueue queue, uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
      ++counts_.submissions;
      submissionOf_[fence] = ++submittedCount_;
      return submit_(queue, count, infos, fence);
    };
    vkGetFenceStatus = [](VkDevice, VkFence fence) {
      return submissionOf_[fence] <= endedCount_ ? VK_SUCCESS : VK_NOT_READY;
    };
    vkCreateBuffer = [](VkDevice device, const VkBufferCreateInfo* info, const VkAllocationCallbacks* callbacks,
                        VkBuffer* buffer) {
      const VkResult result = createBuffer_(device, info, callbacks, buffer);
      usages_[*buffer] = info->usage;
      return result;
    };
    vkCmdCopyBuffer = [](VkCommandBuffer commands, VkBuffer from, VkBuffer to, uint32_t count,
                         const VkBufferCopy* regions) {
      for (const VkBufferCopy& region : std::span(regions, count)) {  // Staging memory has no other usage.
        if (usages_[from] == VK_BUFFER_USAGE_TRANSFER_SRC_BIT) counts_.bytesUp += region.size;
        if (usages_[to] == VK_BUFFER_USAGE_TRANSFER_DST_BIT) counts_.bytesDown += region.size;
      }
      copy_(commands, from, to, count, regions);
    };
  }
  ~CallCounter() {
    vkAllocateMemory = allocate_, vkCreateDescriptorPool = createPool_, vkCreateFence = createFence_;
    vkWaitForFences = wait_, vkQueueSubmit = submit_, vkCreateBuffer = createBuffer_, vkCmdCopyBuffer = copy_;
    vkGetFenceStatus = getStatus_;
  }
  CallCounter(const CallCounter&) = delete;
  CallCounter& operator=(const CallCounter&) = delete;

  /// The counts since the last call.
  [[nodiscard]] CallCounts take() { return std::exchange(counts_, {}); }

 private:
  static inline CallCounts counts_;
  static inline std::unordered_map<VkBuffer, VkBufferUsageFlags> usages_;
  static inline std::unordered_map<VkFence, uint64_t> submissionOf_;
  static inline uint64_t submittedCount_ = 0, endedCount_ = 0;  ///< Submissions end in their order.
  static inline PFN_vkAllocateMemory allocate_ = nullptr;
  static inline PFN_vkCreateDescriptorPool createPool_ = nullptr;
  static inline PFN_vkCreateFence createFence_ = nullptr;
  static inline PFN_vkWaitForFences wait_ = nullptr;
  static inline PFN_vkQueueSubmit submit_ = nullptr;
  static inline PFN_vkCreateBuffer createBuffer_ = nullptr;
  static inline PFN_vkCmdCopyBuffer copy_ = nullptr;
  static inline PFN_vkGetFenceStatus getStatus_ = nullptr;
};

}  // namespace

TEST_CASE("from the second mesh on, a GPU allocates nothing; the host waits for it a few times") {
  const FakeDevice fake(kCountedGpu);
  Session session({.backend = BackendChoice::Vulkan});
  CallCounter counter;
  const Mesh first = makeTorus(20'000).mesh, second = makeAnimal(19'000).mesh, third = makeAnimal(5000).mesh;
  for (const bool hasAllSeeds : {false, true}) {
    const Options options = hasAllSeeds ? test::allSeeds() : test::tenthOfFaces();
    (void)session.compute(first, options);
    for (const Mesh* mesh : {&second, &third, &first}) {
      (void)counter.take();
      (void)session.compute(*mesh, options);
      const CallCounts counts = counter.take();
      CAPTURE(hasAllSeeds);
      CAPTURE(mesh->faces.size());
      MESSAGE(counts.submissions, " submissions, ", counts.waits, " waits");
      CHECK(counts.submissions > 0);
      CHECK(counts.allocations == 0);
      CHECK(counts.descriptorPools == 0);
      CHECK(counts.fences == 0);
      CHECK(counts.waits <= (hasAllSeeds ? 4 : 10));
    }
  }
}

TEST_CASE("hits stay on the device: the bytes that a bus transfers do not depend on the number of rays") {
  const FakeDevice fake(kCountedGpu);
  Session session({.backend = BackendChoice::Vulkan});
  CallCounter counter;
  const Mesh mesh = makeAnimal(20'000).mesh;
  const auto countsOf = [&](uint32_t rayCount) {
    Options options = test::tenthOfFaces();
    options.cone.rayCount = rayCount;
    (void)session.compute(mesh, options);  // Checks the kernels for this number of rays.
    (void)counter.take();
    const auto seedCount = static_cast<double>(session.compute(mesh, options).report.seedCount);
    const CallCounts counts = counter.take();
    MESSAGE(rayCount, " rays, bytes per seed: ", static_cast<double>(counts.bytesUp) / seedCount, " up, ",
            static_cast<double>(counts.bytesDown) / seedCount, " down");
    return counts;
  };
  const CallCounts few = countsOf(30), many = countsOf(60);
  CHECK(few.bytesUp > 0);
  CHECK(few.bytesDown > 0);
  constexpr uint64_t kMaxRayTableByteCount = 4096;  // Tables of the directions, and a state of the solver.
  CHECK(many.bytesUp <= few.bytesUp + kMaxRayTableByteCount);
  CHECK(many.bytesDown <= few.bytesDown + kMaxRayTableByteCount);
}

TEST_CASE("where the host maps the memory of the device, uploads need neither copies nor submissions") {
  const Mesh mesh = makeTorus(20'000).mesh;
  std::vector<double> values[2];
  CallCounts counts[2];
  for (const int isMapped : {0, 1}) {
    FakeDevice::Variables variables = kCountedGpu;
    if (isMapped != 0) variables.emplace_back("ASDF_VK_FAKE_MAPPABLE_MEMORY", "8589934592");
    const FakeDevice fake(variables);
    Session session({.backend = BackendChoice::Vulkan});
    CallCounter counter;
    (void)session.compute(mesh, test::tenthOfFaces());
    (void)counter.take();
    values[isMapped] = session.compute(mesh, test::tenthOfFaces()).sdf();
    counts[isMapped] = counter.take();
  }
  MESSAGE(counts[0].submissions, " submissions, with mapped memory ", counts[1].submissions);
  CHECK(test::haveSameBits(values[0], values[1]));
  CHECK(counts[0].bytesUp > 0);
  CHECK(counts[1].bytesUp == 0);
  CHECK(counts[1].allocations == 0);
  CHECK(counts[1].submissions < counts[0].submissions);
  CHECK(counts[1].waits <= 10);
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
