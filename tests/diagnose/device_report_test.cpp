#include "diagnose/device_report.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <stop_token>
#include <string>

#include "asdf_vk/choices.h"
#include "asdf_vk/error.h"
#include "support/require_failure.h"

using namespace asdfvk;

namespace {

constexpr double kShortest = 0;  // Seconds per run.

/// A report in which everything passed.
DeviceReport goodReport() {
  DeviceReport report;
  report.device.emplace();
  report.tracers = {{.backend = "vulkan",
                     .variant = TraceVariant{TraceKernel::Seed, BvhFetch::Texel},
                     .isDefault = true,
                     .passed = true,
                     .raysPerSecond = 10},
                    {.backend = "vulkan",
                     .variant = TraceVariant{TraceKernel::Ray, BvhFetch::Texel},
                     .passed = true,
                     .raysPerSecond = 20},
                    {.backend = "cpu", .passed = true, .raysPerSecond = 30}};
  report.solvers = {{.name = "cg", .passed = true}};
  return report;
}

}  // namespace

TEST_CASE("a device report passes unless something failed or the default variant did not run") {
  CHECK(goodReport().passed());
  const auto passesWith = [](auto change) {
    DeviceReport report = goodReport();
    change(report);
    return report.passed();
  };
  const auto refuse = [](TracerReport& tracer) {
    tracer.passed = false;
    tracer.refusal = "too few texels";
  };
  CHECK_FALSE(passesWith([](DeviceReport& report) { report.failure.emplace(ErrorCode::NoVulkanDriver, "no driver"); }));
  CHECK_FALSE(passesWith([](DeviceReport& report) { report.tracers[1].passed = false; }));
  CHECK_FALSE(passesWith([](DeviceReport& report) { report.tracers[2].passed = false; }));
  CHECK_FALSE(passesWith([](DeviceReport& report) { report.solvers[0].passed = false; }));
  CHECK_FALSE(passesWith([&](DeviceReport& report) { refuse(report.tracers[0]); }));
  CHECK(passesWith([&](DeviceReport& report) { refuse(report.tracers[1]); }));
  CHECK(passesWith([](DeviceReport& report) {
    report.solvers[0].passed = false;
    report.solvers[0].refusal = "too few storage buffers";
  }));
  CHECK_FALSE(passesWith([](DeviceReport& report) { report.tracers.clear(); }));
}

TEST_CASE("the fastest variant is one of the device that passed") {
  DeviceReport report = goodReport();
  REQUIRE(report.fastest() == &report.tracers[1]);
  report.tracers[1].passed = false;
  REQUIRE(report.fastest() == &report.tracers[0]);
  report.tracers[0].passed = false;
  CHECK(report.fastest() == nullptr);
}

TEST_CASE("each variant and solver of the device gives the values of the CPU" * doctest::test_suite("slow")) {
  if (listDevices().empty()) {
    MESSAGE("skipped: no Vulkan device");
    return;
  }
  const DeviceReport report = reportDevice({.backend = BackendChoice::Vulkan}, {}, kShortest);
  REQUIRE(report.device);
  CHECK(report.passed());
  CHECK_FALSE(report.failure);
  CHECK(report.deviceLines.at(0).find(report.device->name) != std::string::npos);
  std::set<std::string> variants;
  for (const TracerReport& tracer : report.tracers) {
    CAPTURE(tracer.failure);
    REQUIRE(tracer.variant);
    const std::string variant =
        std::string(nameOf(kKernels, *tracer.variant->kernel)) + nameOf(kFetches, *tracer.variant->fetch);
    CAPTURE(variant);
    variants.insert(variant);
    CHECK(tracer.backend == "vulkan");
    if (!tracer.refusal.empty()) continue;
    CHECK(tracer.passed);
    CHECK(tracer.comparedCount == 64);
    CHECK(tracer.raysPerSecond > 0);
  }
  CHECK(variants.size() == 6);
  CHECK(std::count_if(report.tracers.begin(), report.tracers.end(),
                      [](const TracerReport& tracer) { return tracer.isDefault; }) == 1);
  CHECK(report.fastest() != nullptr);
  REQUIRE(report.solvers.size() == 2);
  for (const SolverCheckReport& solver : report.solvers) {
    CAPTURE(solver.name);
    CAPTURE(solver.failure);
    CAPTURE(solver.difference);
    if (!solver.refusal.empty()) continue;
    CHECK(solver.passed);
    CHECK(solver.unknownCount == 35'000);
    CHECK(solver.iterations > 0);
    CHECK(solver.difference > 0);
  }
}

TEST_CASE("without Vulkan the report is of the requested backend, and a stop request ends it") {
  const DeviceReport report = reportDevice({.backend = BackendChoice::Reference}, {}, kShortest);
  CHECK_FALSE(report.device);
  CHECK(report.passed());
  REQUIRE(report.tracers.size() == 1);
  CHECK(report.tracers[0].backend == "reference");
  CHECK_FALSE(report.tracers[0].variant);
  CHECK(report.solvers.empty());

  test::requireFailure(
      [] { return reportDevice({.backend = BackendChoice::Vulkan, .device = "no such device"}, {}, kShortest); },
      ErrorCode::NoUsableDevice, "no such device");
  std::stop_source source;
  source.request_stop();
  RunControl control;
  control.stop = source.get_token();
  test::requireFailure([&] { return reportDevice({.backend = BackendChoice::Reference}, control, kShortest); },
                       ErrorCode::Cancelled);
}
