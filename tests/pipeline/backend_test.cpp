#include "pipeline/backend.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "asdf_vk/choices.h"
#include "support/require_failure.h"
#include "trace/cone_tracer.h"

using namespace asdfvk;

namespace {

void requireOpenFailure(const SessionOptions& options, ErrorCode code, const std::string& part = "") {
  CAPTURE(nameOf(kBackendNames, options.backend));
  test::requireFailure([&] { (void)openBackend(options); }, code, part);
}

bool hasDevice(const std::function<bool(const DeviceInfo&)>& predicate) {
  const std::vector<DeviceInfo> devices = listDevices();
  return std::any_of(devices.begin(), devices.end(), predicate);
}

}  // namespace

TEST_CASE("a required GPU, a device and a kernel variant exclude the backends without Vulkan") {
  for (const BackendChoice backend : {BackendChoice::Cpu, BackendChoice::Reference}) {
    requireOpenFailure({.backend = backend, .requireGpu = true}, ErrorCode::GpuRequired, "a GPU was required");
    requireOpenFailure({.backend = backend, .device = "0"}, ErrorCode::NoDeviceForKernel, "a Vulkan device");
    requireOpenFailure({.backend = backend, .variant = {.kernel = TraceKernel::Ray}}, ErrorCode::NoDeviceForKernel,
                       "kernel variant");
    requireOpenFailure({.backend = backend, .variant = {.fetch = BvhFetch::Texel}}, ErrorCode::NoDeviceForKernel,
                       "kernel variant");
  }
}

TEST_CASE("a CPU device of Vulkan is rejected where a GPU is required, and auto does not fall back") {
  if (listDevices().empty() || hasDevice([](const DeviceInfo& device) { return device.kind != "CPU"; })) return;
  for (const BackendChoice backend : {BackendChoice::Vulkan, BackendChoice::Automatic})
    requireOpenFailure({.backend = backend, .requireGpu = true}, ErrorCode::GpuRequired);
}

TEST_CASE("a device that does not exist is an error, and auto does not fall back") {
  if (listDevices().empty()) return;
  for (const BackendChoice backend : {BackendChoice::Vulkan, BackendChoice::Automatic})
    requireOpenFailure({.backend = backend, .device = "no such device"}, ErrorCode::NoUsableDevice);
}

TEST_CASE("auto is Vulkan wherever a Vulkan device is usable, also one of the CPU") {
  const NamedBackend named = openBackend({});
  if (hasDevice([](const DeviceInfo& device) { return device.usable; })) {
    CHECK(named.name == "vulkan");
    CHECK(named.backend->hasDevice());
    CHECK(named.backend->traceVariant().has_value());
  } else {
    CHECK(named.name == "cpu");
    CHECK(named.deviceLines.back().starts_with("vulkan: not available: "));
  }
  CHECK_FALSE(named.deviceLines.empty());
}

TEST_CASE("the reference has no device, no variant and agrees with itself by construction") {
  const NamedBackend named = openBackend({.backend = BackendChoice::Reference});
  CHECK(named.name == "reference");
  CHECK(named.backend->isReference());
  CHECK(named.backend->runsOnCpu());
  CHECK_FALSE(named.backend->hasDevice());
  CHECK_FALSE(named.backend->traceVariant().has_value());
  CHECK(named.deviceLines.size() == 1);
}

TEST_CASE("a requested kernel variant is the one that the backend has") {
  if (!hasDevice([](const DeviceInfo& device) { return device.usable; })) return;
  const NamedBackend named = openBackend({.variant = {.kernel = TraceKernel::Ray, .fetch = BvhFetch::Storage}});
  const TraceVariant variant = named.backend->traceVariant().value();
  CHECK(variant.kernel == TraceKernel::Ray);
  CHECK(variant.fetch == BvhFetch::Storage);
}
