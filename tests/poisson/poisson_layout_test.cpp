#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <vector>

#include "shared/equation_layout.h"
#include "shared/poisson_layout.h"
#include "spirv/equation_layout_probe.comp.h"
#include "spirv/poisson_layout_probe.comp.h"
#include "support/probe.h"
#include "support/test_device.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

using namespace asdfvk;

TEST_CASE("a distinct word through each field of the Poisson structs arrives in that field of the kernel") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  uint32_t next = 1000;
  std::vector<uint32_t> expected;
  const auto word = [&] {
    expected.push_back(++next);
    return next;
  };
  const auto real = [&] { return std::bit_cast<float>(word() | 0x3f800000u); };
  std::array<CgState, 2> states{};
  for (CgState& state : states) {
    state.residualSquared = real();
    state.toleranceSquared = real();
    state.iterationCount = word();
    state.status = word();
  }
  PoissonPush push{};
  push.unknownCount = word();
  push.stateIndex = word();
  push.workgroupCount = word();
  DispatchSize size{};
  size.x = word();
  size.y = word();
  size.z = word();
  PoissonSums sums{};
  PoissonRow row{};
  row.column0 = word();
  row.column1 = word();
  row.column2 = word();
  row.tailBegin = word();
  row.tailCount = word();
  row.coupling0 = real();
  row.coupling1 = real();
  row.coupling2 = real();
  for (float& sum : sums.directionSquared) sum = real();
  for (float& sum : sums.productDot) sum = real();
  for (float& sum : sums.productSquared) sum = real();
  for (float& sum : sums.residualProduct) sum = real();
  for (float& sum : sums.residualDot) sum = real();
  for (float& sum : sums.residualSquared) sum = real();

  const Buffer stateBuffer = uploadBuffer(*device, bytesOf(states), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Buffer sumBuffer = uploadBuffer(*device, bytesOf(sums), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Buffer sizeBuffer = uploadBuffer(*device, bytesOf(size), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Buffer rowBuffer = uploadBuffer(*device, bytesOf(row), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Buffer words(*device, expected.size() * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                     MemoryKind::HostVisible);
  const ComputePipeline probe(*device, {"poisson_layout_probe.comp",
                                        k_poisson_layout_probe_comp,
                                        std::vector(5, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
                                        sizeof(PoissonPush),
                                        {}});
  test::runProbe(*device, probe, std::array<Binding, 5>{stateBuffer, sumBuffer, words, rowBuffer, sizeBuffer},
                 bytesOf(push));
  const std::span<const uint32_t> got = words.mappedAs<uint32_t>();
  for (size_t i = 0; i < expected.size(); ++i) {
    const bool isReal = i < 8 ? i % 4 < 2 : i > 18;
    CAPTURE(i);
    REQUIRE(got[i] == (isReal ? expected[i] | 0x3f800000u : expected[i]));
  }
}

TEST_CASE("a distinct number through each field of the structs of an equation arrives in that field of the kernel") {
  const test::ValidatedDevice device;
  const std::array<EquationStart, 2> starts{{{1.5f, 2.5f, 3}, {4.5f, 5.5f, 6}}};
  const EquationPush push{.faceCount = 7, .workgroupCount = 8, .scale = 9.5f};
  const Buffer startBuffer = uploadBuffer(*device, bytesOf(starts), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Buffer words(*device, 9 * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::HostVisible);
  const ComputePipeline probe(*device, {"equation_layout_probe.comp",
                                        k_equation_layout_probe_comp,
                                        std::vector(2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
                                        sizeof(EquationPush),
                                        {}});
  test::runProbe(*device, probe, std::array<Binding, 2>{startBuffer, words}, bytesOf(push));
  const std::span<const uint32_t> got = words.mappedAs<uint32_t>();
  for (uint32_t i = 0; i < 9; ++i) {
    CAPTURE(i);
    const bool isReal = i < 6 ? i % 3 != 2 : i == 8;
    CHECK(got[i] == (isReal ? std::bit_cast<uint32_t>(static_cast<float>(i) + 1.5f) : i + 1));
  }
}
