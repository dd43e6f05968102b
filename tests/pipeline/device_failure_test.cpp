#include <doctest/doctest.h>
#include <volk.h>

#include <cstring>
#include <string>
#include <vector>

#include "asdf_vk/scene.h"
#include "asdf_vk/session.h"
#include "generate/shapes.h"
#include "shared/cone_layout.h"
#include "support/bits.h"
#include "support/require_failure.h"
#include "support/shared_session.h"
#include "trace/cone_tracer.h"

using namespace asdfvk;
using test::findWarning;
using test::requireFailure;

namespace {

/// While it exists, every submission from the nth on loses the device.
class LostDevice {
 public:
  explicit LostDevice(uint32_t n) : submit_(vkQueueSubmit) {
    original = submit_;
    remaining = n;
    vkQueueSubmit = [](VkQueue queue, uint32_t count, const VkSubmitInfo* infos, VkFence fence) -> VkResult {
      if (remaining <= 1) return VK_ERROR_DEVICE_LOST;
      --remaining;
      return original(queue, count, infos, fence);
    };
  }
  ~LostDevice() { vkQueueSubmit = submit_; }
  LostDevice(const LostDevice&) = delete;
  LostDevice& operator=(const LostDevice&) = delete;

 private:
  static inline PFN_vkQueueSubmit original = nullptr;
  static inline uint32_t remaining = 0;
  PFN_vkQueueSubmit submit_;
};

/// While it exists, the device has no memory left.
class FullDevice {
 public:
  FullDevice() : allocate_(vkAllocateMemory) {
    vkAllocateMemory = [](VkDevice, const VkMemoryAllocateInfo*, const VkAllocationCallbacks*,
                          VkDeviceMemory*) -> VkResult { return VK_ERROR_OUT_OF_DEVICE_MEMORY; };
  }
  ~FullDevice() { vkAllocateMemory = allocate_; }
  FullDevice(const FullDevice&) = delete;
  FullDevice& operator=(const FullDevice&) = delete;

 private:
  PFN_vkAllocateMemory allocate_;
};

/// While it exists, kernels drop all hits as false, so that no face has a value.
class WrongDevice {
 public:
  WrongDevice() : push_(vkCmdPushConstants) {
    original = push_;
    vkCmdPushConstants = [](VkCommandBuffer commands, VkPipelineLayout layout, VkShaderStageFlags stages,
                            uint32_t offset, uint32_t byteCount, const void* bytes) {
      ConePush push;
      if (byteCount != sizeof push) return original(commands, layout, stages, offset, byteCount, bytes);
      std::memcpy(&push, bytes, sizeof push);
      push.falseHitCosine = -2;
      original(commands, layout, stages, offset, byteCount, &push);
    };
  }
  ~WrongDevice() { vkCmdPushConstants = push_; }
  WrongDevice(const WrongDevice&) = delete;
  WrongDevice& operator=(const WrongDevice&) = delete;

 private:
  static inline PFN_vkCmdPushConstants original = nullptr;
  PFN_vkCmdPushConstants push_;
};

const std::string kNextBackend = hasEmbree() ? "cpu" : "reference";

void checkReplaced(Session& session, const Mesh& mesh, const Result& result, ErrorCode code) {
  CHECK(result.report.backend == kNextBackend);
  CHECK(session.backend() == kNextBackend);
  CHECK(session.runsOnCpu());
  CHECK_FALSE(result.report.traceVariant);
  const Warning* warning = findWarning(result.report, WarningCode::BackendReplaced);
  REQUIRE(warning != nullptr);
  REQUIRE(warning->details.size() == 2);
  CHECK(warning->details[0].value == "vulkan");
  CHECK(warning->details[1].value == nameOf(code));
  CHECK(session.deviceLines().back().starts_with("vulkan: failed: "));
  Session expected({.backend = kNextBackend});
  CHECK(test::haveSameBits(result.sdf(), expected.compute(mesh).sdf()));
}

}  // namespace

TEST_CASE("auto continues with the next backend when the device is lost, for the mesh and for later ones") {
  const Mesh mesh = makeTorus(1000).mesh, other = makeSphere(500).mesh;
  for (const uint32_t n : {1u, 2u}) {
    CAPTURE(n);
    Session session;
    CHECK(findWarning(session.compute(other).report, WarningCode::BackendReplaced) == nullptr);
    double last = 0;
    const RunControl control{{}, [&](double fraction) {
                               CHECK(fraction >= last);
                               CHECK(fraction <= 1);
                               last = fraction;
                             }};
    const Result result = [&] {
      const LostDevice lost(n);
      return session.compute(mesh, {}, control);
    }();
    CHECK(last == 1);
    checkReplaced(session, mesh, result, ErrorCode::DeviceLost);
    checkReplaced(session, other, session.compute(other), ErrorCode::DeviceLost);
  }
}

TEST_CASE("auto continues with the next backend when the device has no memory left") {
  const Mesh mesh = makeTorus(1000).mesh;
  Session session;
  const FullDevice full;
  checkReplaced(session, mesh, session.compute(mesh), ErrorCode::OutOfDeviceMemory);
}

TEST_CASE("a device with wrong values is refused at its first use") {
  const Mesh mesh = makeTorus(1000).mesh;
  {
    Session session, requested({.backend = "vulkan"});
    const WrongDevice wrong;
    checkReplaced(session, mesh, session.compute(mesh), ErrorCode::NoUsableDevice);
    requireFailure([&] { (void)requested.compute(mesh); }, ErrorCode::NoUsableDevice,
                   "computes wrong values: 64 of 64");
  }
  Session session;
  (void)session.compute(mesh);
  CHECK(session.backend() == "vulkan");
}

TEST_CASE("a requested backend, device, variant or solver of the device is not replaced") {
  const Mesh mesh = makeTorus(1000).mesh;
  for (const SessionOptions& options : {SessionOptions{.backend = "vulkan"}, SessionOptions{.device = "0"},
                                        SessionOptions{.variant = {.bvh = "wide"}}}) {
    Session session(options);
    {
      const LostDevice lost(1);
      requireFailure([&] { (void)session.compute(mesh); }, ErrorCode::DeviceLost, "the device was lost");
    }
    CHECK(session.backend() == "vulkan");
    const FullDevice full;
    requireFailure([&] { (void)session.compute(mesh); }, ErrorCode::OutOfDeviceMemory, "out of device memory");
  }
  Session session;
  Options options;
  options.solver = "cg";
  const LostDevice lost(1);
  requireFailure([&] { (void)session.compute(mesh, options); }, ErrorCode::DeviceLost);
}

TEST_CASE("a scene continues with the backend that replaces a lost device") {
  const Mesh mesh = makeTorus(1000).mesh;
  Session session, expectedSession({.backend = kNextBackend});
  Scene scene(session, mesh), other(session, mesh), expected(expectedSession, mesh);
  (void)scene.compute();
  (void)other.compute();
  const std::vector<double> points{0.5, 0.5, 0.5}, normals{0, 0, 1};
  {
    const LostDevice lost(1);
    CHECK(test::haveSameBits(scene.valuesAt(points, normals), expected.valuesAt(points, normals)));
  }
  CHECK(session.backend() == kNextBackend);
  for (Scene* each : {&scene, &other}) {
    const Result result = each->compute();
    CHECK(findWarning(result.report, WarningCode::BackendReplaced) != nullptr);
    CHECK(test::haveSameBits(result.sdf(), expected.compute().sdf()));
  }
}
