#include "pipeline/backend.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "support/require_failure.h"
#include "trace/cone_tracer.h"

using namespace asdfvk;

namespace {

void requireOpenFailure(const SessionOptions& options, ErrorCode code, const std::string& part = "") {
  CAPTURE(options.backend);
  test::requireFailure([&] { (void)openBackend(options); }, code, part);
}

bool hasDevice(const std::function<bool(const DeviceInfo&)>& predicate) {
  const std::vector<DeviceInfo> devices = listDevices();
  return std::any_of(devices.begin(), devices.end(), predicate);
}

}  // namespace

TEST_CASE("a name that no backend has is an error with all names") {
  requireOpenFailure({.backend = "cuda"}, ErrorCode::UnknownName, "'cuda'; the names are auto, vulkan, cpu, reference");
  requireOpenFailure({.backend = ""}, ErrorCode::UnknownName, "''");
  requireOpenFailure({.backend = "Vulkan"}, ErrorCode::UnknownName, "'Vulkan'");
}

TEST_CASE("the table has every backend, in the order of auto") {
  CHECK(backendNames() == std::vector<std::string>{"vulkan", "cpu", "reference"});
}

TEST_CASE("a required GPU, a device and a kernel variant exclude the backends without Vulkan") {
  for (const std::string backend : {"cpu", "reference"}) {
    requireOpenFailure({.backend = backend, .requireGpu = true}, ErrorCode::GpuRequired, "a GPU was required");
    requireOpenFailure({.backend = backend, .device = "0"}, ErrorCode::NoDeviceForKernel, "a Vulkan device");
    requireOpenFailure({.backend = backend, .variant = {.kernel = "ray"}}, ErrorCode::NoDeviceForKernel,
                       "kernel variant");
    requireOpenFailure({.backend = backend, .variant = {.fetch = "texel"}}, ErrorCode::NoDeviceForKernel,
                       "kernel variant");
  }
}

TEST_CASE("a name that no kernel variant has is an error, also with auto") {
  for (const std::string backend : {"vulkan", "auto"}) {
    requireOpenFailure({.backend = backend, .variant = {.kernel = "warp"}}, ErrorCode::UnknownName, "warp");
    requireOpenFailure({.backend = backend, .variant = {.fetch = "image"}}, ErrorCode::UnknownName, "image");
  }
}

TEST_CASE("a CPU device of Vulkan is rejected where a GPU is required, and auto does not fall back") {
  if (listDevices().empty() || hasDevice([](const DeviceInfo& device) { return device.kind != "CPU"; })) return;
  for (const std::string backend : {"vulkan", "auto"})
    requireOpenFailure({.backend = backend, .requireGpu = true}, ErrorCode::GpuRequired);
}

TEST_CASE("a device that does not exist is an error, and auto does not fall back") {
  if (listDevices().empty()) return;
  for (const std::string backend : {"vulkan", "auto"})
    requireOpenFailure({.backend = backend, .device = "no such device"}, ErrorCode::NoUsableDevice);
}

TEST_CASE("auto is Vulkan wherever a Vulkan device is usable, also one of the CPU") {
  const NamedBackend named = openBackend({});
  if (hasDevice([](const DeviceInfo& device) { return device.usable; })) {
    CHECK(named.name == "vulkan");
    CHECK(named.backend->device() != nullptr);
    CHECK(named.backend->traceVariant().has_value());
  } else {
    CHECK(named.name == "cpu");
    CHECK(named.deviceLines.back().starts_with("vulkan: not available: "));
  }
  CHECK_FALSE(named.deviceLines.empty());
}

TEST_CASE("the reference has no device, no variant and agrees with itself by construction") {
  const NamedBackend named = openBackend({.backend = "reference"});
  CHECK(named.name == "reference");
  CHECK(named.backend->isReference());
  CHECK(named.backend->runsOnCpu());
  CHECK(named.backend->device() == nullptr);
  CHECK_FALSE(named.backend->traceVariant().has_value());
  CHECK(named.deviceLines.size() == 1);
}

TEST_CASE("a requested kernel variant is the one that the backend has") {
  if (!hasDevice([](const DeviceInfo& device) { return device.usable; })) return;
  const NamedBackend named = openBackend({.variant = {.kernel = "ray", .fetch = "storage"}});
  const TraceVariant variant = named.backend->traceVariant().value();
  CHECK(variant.kernel == "ray");
  CHECK(variant.fetch == "storage");
}
