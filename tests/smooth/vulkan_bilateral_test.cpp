#include "smooth/vulkan/vulkan_bilateral.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asdf_vk/error.h"
#include "sample_fields.h"
#include "shared/bilateral_layout.h"
#include "spirv/bilateral_layout_probe.comp.h"
#include "support/test_device.h"
#include "vk/command_list.h"

using namespace asdfvk;
using test::kNaN;

namespace {

// The largest difference over the largest value, or infinity when the two differ in which faces have a value.
double difference(const std::vector<double>& device, const std::vector<double>& twin) {
  REQUIRE(device.size() == twin.size());
  double largest = 0, worst = 0;
  for (size_t i = 0; i < twin.size(); ++i) {
    if (std::isnan(twin[i]) != std::isnan(device[i])) return std::numeric_limits<double>::infinity();
    if (std::isnan(twin[i])) continue;
    largest = std::max(largest, std::abs(twin[i]));
    worst = std::max(worst, std::abs(device[i] - twin[i]));
  }
  return worst / largest;
}

struct Smoother {
  test::ValidatedDevice device;
  VulkanBilateralKernel kernel{*device};

  std::vector<double> operator()(const DualGraph& graph, const std::vector<double>& values,
                                 const BilateralOptions& options) const {
    return smoothBilaterallyOnDevice(*device, kernel, graph, values, options);
  }
};

}  // namespace

TEST_CASE("a distinct word through each field of the push constants arrives where the kernel reads it") {
  const test::ValidatedDevice device;
  const BilateralPush push{1001, 1002, 1003};
  const Buffer words(*device, 3 * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::HostVisible);
  const ComputePipeline probe(*device, {"bilateral_layout_probe.comp",
                                        k_bilateral_layout_probe_comp,
                                        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                                        sizeof(BilateralPush),
                                        {}});
  const BindingSet bindings(*device, probe, std::array<Binding, 1>{words});
  CommandList commands(*device);
  commands.begin();
  commands.dispatch(probe, bindings, bytesOf(push), 1);
  commands.barrier();
  commands.submitAndWait();
  for (uint32_t i = 0; i < 3; ++i) CHECK(words.mappedAs<uint32_t>()[i] == 1001 + i);
}

TEST_CASE("the kernel gives what its twin on the CPU gives, in every window and after every number of passes") {
  const Smoother smooth;
  for (const char* shape : {"torus", "animal"}) {
    const DualGraph graph = buildDualGraph(generateShape(shape, 5000).mesh);
    REQUIRE(graph.faceCount() % 64 != 0);
    std::vector<double> values = test::noisyField(graph.faceCount(), 3, 1);
    for (uint32_t face = 0; face < graph.faceCount(); face += 11) values[face] = kNaN;
    for (uint32_t window : {1u, 2u, 3u, 4u})
      for (uint32_t passes : {0u, 1u, 2u, 3u}) {
        CAPTURE(window);
        CAPTURE(passes);
        const BilateralOptions options{window, passes};
        CHECK(difference(smooth(graph, values, options), smoothBilaterally(graph, values, options)) < 1e-5);
      }
  }
}

TEST_CASE("the kernel cuts the same windows where very many faces meet") {
  const Smoother smooth;
  std::vector<DualGraph> graphs{test::completeGraph(70)};  // Cut by the faces; these by the arcs.
  for (uint32_t faceCount : {8u, 31u, 33u, 90u}) graphs.push_back(test::coincidentGraph(faceCount));
  for (const DualGraph& graph : graphs) {
    CAPTURE(graph.faceCount());
    const std::vector<double> values = test::noisyField(graph.faceCount(), 3, 1);
    const BilateralOptions options{4, 2};
    CHECK(difference(smooth(graph, values, options), smoothBilaterally(graph, values, options)) < 1e-5);
  }
}

TEST_CASE("values whose squares float32 has not got are smoothed alike") {
  const Smoother smooth;
  const DualGraph graph = test::torusGraph(600);
  for (double unit : {1e-300, 1e-30, 1e30, 1e300}) {
    std::vector<double> values = test::noisyField(graph.faceCount(), 3, 1);
    for (double& value : values) value *= unit;
    CHECK(difference(smooth(graph, values, {2, 1}), smoothBilaterally(graph, values, {2, 1})) < 1e-5);
  }
}

TEST_CASE("what has nothing to be smoothed with stays as it is, to float32") {
  const Smoother smooth;
  const DualGraph graph = test::torusGraph(600);
  const std::vector<double> constant(graph.faceCount(), 0.75), zero(graph.faceCount(), 0.0);
  CHECK(smooth(graph, constant, {2, 3}) == constant);
  CHECK(smooth(graph, zero, {2, 1}) == zero);
  CHECK(smooth(test::graphOf({{}, {}}), {7.5, 3}, {4, 1}) == std::vector<double>{7.5, 3});
  for (double value : smooth(test::stripGraph(2), {kNaN, kNaN}, {1, 1})) CHECK(std::isnan(value));
  CHECK(smooth(test::graphOf({}), {}, {2, 1}).empty());
}

TEST_CASE("more faces than one dispatch may have are all smoothed") {
  const Smoother smooth;
  const uint32_t faceCount = std::min<uint32_t>(smooth.device->facts().maxWorkgroupCount, 65'535) * 64 + 1000;
  const DualGraph graph = test::stripGraph(faceCount);
  const std::vector<double> values = test::noisyField(faceCount, 3, 1);
  CHECK(difference(smooth(graph, values, {1, 1}), smoothBilaterally(graph, values, {1, 1})) < 1e-5);
}

TEST_CASE("the device repeats itself to the bit") {
  const Smoother smooth;
  const DualGraph graph = test::torusGraph(20000);
  const std::vector<double> values = test::noisyField(graph.faceCount(), 3, 1);
  CHECK(smooth(graph, values, {2, 2}) == smooth(graph, values, {2, 2}));
}

TEST_CASE("a window out of range is refused on the device too") {
  const Smoother smooth;
  CHECK_THROWS_AS(static_cast<void>(smooth(test::stripGraph(3), {1, 2, 3}, {5, 1})), Error);
}
