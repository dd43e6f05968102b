#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

#include "asdf_vk/error.h"
#include "device_matrix.h"
#include "fixtures.h"
#include "kernel_twins.h"
#include "poisson/cpu_cg.h"
#include "poisson/vk/vulkan_cg.h"
#include "poisson/vk/vulkan_jacobi.h"
#include "spirv/cg_product.comp.h"
#include "spirv/cg_step.comp.h"
#include "spirv/jacobi_sweep.comp.h"
#include "support/specialization_ids.h"
#include "support/test_device.h"

using namespace asdfvk;

namespace {

// Weights of very different size, rows of 0 to 9 entries, faces without an unknown neighbour, more rows than lanes, and
// idle lanes in the last workgroup.
PoissonSystem unevenSystem() {
  const Mesh mesh = torus(211, 101);
  FaceGeometry geometry = computeFaceGeometry(mesh);
  Random random(3);
  for (Vec3d& p : geometry.barycentres) p = p + Vec3d{0.2 * random.real(), 0.2 * random.real(), 0.2 * random.real()};
  DualGraph graph = buildDualGraph(mesh);
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (uint32_t f = 0; f < graph.faceCount(); ++f)
    for (uint32_t g : graph.neighboursOf(f))
      if (f < g) edges.emplace_back(f, g);
  for (uint32_t f = 0; f < 6000; ++f) edges.emplace_back(f, (f * 7u + 1000u) % graph.faceCount());
  std::vector<double> values(graph.faceCount(), kNoValue);
  for (double& value : values)
    if (random.index(8) == 0) value = 1 + random.real();
  const HandGraph hand({geometry.barycentres.begin(), geometry.barycentres.end()}, edges);
  return distanceSystem(hand.graph, hand.geometry, values);
}

std::vector<double> randomResidual(size_t size) {
  Random random(11);
  std::vector<double> residual(size);
  for (double& entry : residual) entry = 1000 * (random.real() - 0.3);
  return residual;
}

std::vector<float> copyOf(std::span<const float> vector) { return {vector.begin(), vector.end()}; }

// Largest difference over the largest entry of the twin; NaN where an entry is NaN.
double difference(std::span<const float> kernel, const std::vector<double>& twin) {
  REQUIRE(kernel.size() == twin.size());
  double largest = 0, worst = 0;
  for (size_t i = 0; i < twin.size(); ++i) {
    largest = std::max(largest, std::abs(twin[i]));
    const double each = std::abs(static_cast<double>(kernel[i]) - twin[i]);
    if (!(each <= worst)) worst = each;
  }
  return worst / largest;
}

template <typename Vector>
Buffer vectorOn(const Device& device, const Vector& vector) {
  return uploadVector(device, vector, kPoissonVectorUsage);
}

}  // namespace

TEST_CASE("residuals are scaled and corrections scaled back as defined") {
  const PoissonSystem system = unevenSystem();
  const ScaledSystem scaled(system);
  const std::vector<double> residual = randomResidual(system.unknownCount());
  const UnsetVector<float> b = scaled.scaleResidual(residual, KernelTwins{system}.norm(residual));
  CHECK(difference(b, KernelTwins{system}.scaled(residual)) < 1e-6);
  double squared = 0;
  for (size_t i = 0; i < b.size(); ++i)
    squared += static_cast<double>(b[i]) * static_cast<double>(b[i]) * static_cast<double>(scaled.residualWeights()[i]);
  CHECK(squared == doctest::Approx(1));
  // For S = 0, y = b and the correction is the residual over the diagonal.
  std::vector<double> correction(b.size());
  scaled.unscaleCorrection(b, KernelTwins{system}.norm(residual), correction);
  for (size_t i = 0; i < b.size(); i += 97)
    CHECK(correction[i] == doctest::Approx(residual[i] / system.diagonal[i]).epsilon(1e-6));
}

TEST_CASE("iterations with one reduction give the vectors of the textbook, on the device and on the CPU") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const PoissonSystem system = unevenSystem();
  const ScaledSystem scaled(system);
  REQUIRE_FALSE(scaled.tailColumns().empty());
  const std::vector<double> residual = randomResidual(system.unknownCount());
  const UnsetVector<float> b = scaled.scaleResidual(residual, KernelTwins{system}.norm(residual));
  const VulkanCgKernels kernels(*device);
  const VulkanMatrix matrix = matrixOn(*device, scaled);
  REQUIRE(system.unknownCount() % (matrix.grid.laneCount * matrix.grid.workgroupCount) != 0);
  REQUIRE(system.unknownCount() > matrix.grid.laneCount * matrix.grid.workgroupCount);
  const auto compare = [&](auto& cg, uint32_t iterationCount) {
    CgTwin twin(system, KernelTwins{system}.scaled(residual));
    const auto state = cg.advance(iterationCount);
    for (uint32_t i = 0; i + 1 < iterationCount; ++i) twin.iterate();
    CHECK(static_cast<double>(state.residualSquared) == doctest::Approx(twin.twins.squaredNorm(twin.r)).epsilon(1e-5));
    twin.iterate();
    CHECK(difference(cg.product(), twin.q) < 1e-5);
    CHECK(difference(cg.solution(), twin.x) < 1e-5);
    CHECK(difference(cg.residual(), twin.r) < 1e-5);
    CHECK(difference(cg.direction(), twin.p) < 1e-5);
    CHECK(state.status == kCgRunning);
    CHECK(state.iterationCount == iterationCount);
  };
  for (uint32_t iterationCount : {1u, 2u, 5u}) {
    CAPTURE(iterationCount);
    const Buffer start = vectorOn(*device, b);
    VulkanCg onDevice(*device, kernels, matrix, start, 0);
    compare(onDevice, iterationCount);
    CpuCg onCpu(scaled, b, 0);
    compare(onCpu, iterationCount);
  }
}

TEST_CASE("iterations after convergence change nothing, for any batches") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const PoissonSystem system = torusSystem(40, 20);
  const ScaledSystem scaled(system);
  const std::vector<double> residual = randomResidual(system.unknownCount());
  const UnsetVector<float> b = scaled.scaleResidual(residual, KernelTwins{system}.norm(residual));
  const VulkanCgKernels kernels(*device);
  const VulkanMatrix matrix = matrixOn(*device, scaled);
  const auto compare = [](auto& atOnce, auto& stepwise) {
    const auto state = atOnce.advance(301);
    CHECK(state.status == kCgConverged);
    CHECK(state.iterationCount > 3);
    CHECK(state.iterationCount < 100);
    CHECK(state.residualSquared <= 1e-6f);
    for (uint32_t i = 0; i <= state.iterationCount; ++i) {
      const auto step = stepwise.advance(1);
      CHECK(step.iterationCount == std::min(i + 1, state.iterationCount));
      CHECK(step.status == (i < state.iterationCount ? kCgRunning : kCgConverged));
    }
    CHECK(copyOf(atOnce.solution()) == copyOf(stepwise.solution()));
    CHECK(copyOf(atOnce.residual()) == copyOf(stepwise.residual()));
    for (uint32_t more : {1u, 2u}) {
      const auto after = stepwise.advance(more);
      CHECK(after.iterationCount == state.iterationCount);
      CHECK(after.status == kCgConverged);
      CHECK(after.residualSquared == state.residualSquared);
    }
    CHECK(copyOf(atOnce.direction()) == copyOf(stepwise.direction()));
  };
  const Buffer start = vectorOn(*device, b);
  VulkanCg atOnce(*device, kernels, matrix, start, 1e-3), stepwise(*device, kernels, matrix, start, 1e-3);
  CHECK(atOnce.workgroupCount() == matrix.grid.workgroupCount);
  compare(atOnce, stepwise);
  CHECK(atOnce.workgroupCount() == 0);
  CHECK(stepwise.workgroupCount() == 0);
  CpuCg atOnceOnCpu(scaled, b, 1e-3), stepwiseOnCpu(scaled, b, 1e-3);
  compare(atOnceOnCpu, stepwiseOnCpu);
}

TEST_CASE("an exact solution ends the iteration without a division of 0 by 0") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const PoissonSystem system = chain(3, 1, 3);
  const ScaledSystem scaled(system);
  const VulkanCgKernels kernels(*device);
  const VulkanMatrix matrix = matrixOn(*device, scaled);
  const auto check = [](auto& cg) {
    const auto state = cg.advance(10);
    CHECK(state.status == kCgConverged);
    CHECK(state.iterationCount == 1);
    CHECK(copyOf(cg.solution()) == std::vector<float>{1});
  };
  const Buffer start = vectorOn(*device, std::vector<float>{1});
  VulkanCg onDevice(*device, kernels, matrix, start, 0);
  check(onDevice);
  CpuCg onCpu(scaled, {1}, 0);
  check(onCpu);
}

TEST_CASE("a product that is not positive ends the iteration as a breakdown") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  PoissonSystem system = chain(4, 1, 3);
  std::fill(system.entries.begin(), system.entries.end(), -10.0);  // indefinite
  const ScaledSystem scaled(system);
  const VulkanCgKernels kernels(*device);
  const VulkanMatrix matrix = matrixOn(*device, scaled);
  const auto check = [](auto& cg) {
    for (uint32_t iterationCount : {10u, 1u, 2u}) {
      const auto state = cg.advance(iterationCount);
      CHECK(state.status == kCgBrokenDown);
      CHECK(state.iterationCount == 0);
    }
    CHECK(copyOf(cg.solution()) == std::vector<float>{0, 0});
  };
  const Buffer start = vectorOn(*device, std::vector<float>{1, 1});
  VulkanCg onDevice(*device, kernels, matrix, start, 1e-3);
  check(onDevice);
  CHECK(onDevice.workgroupCount() == 0);
  CpuCg onCpu(scaled, {1, 1}, 1e-3);
  check(onCpu);
}

TEST_CASE("a right-hand side that is not a number ends the iteration as a breakdown") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const PoissonSystem system = chain(4, 1, 3);
  const ScaledSystem scaled(system);
  const VulkanCgKernels kernels(*device);
  const VulkanMatrix matrix = matrixOn(*device, scaled);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Buffer start = vectorOn(*device, std::vector<float>{nan, 1});
  VulkanCg onDevice(*device, kernels, matrix, start, 1e-3);
  CHECK(onDevice.advance(10).status == kCgBrokenDown);
  CpuCg onCpu(scaled, {nan, 1}, 1e-3);
  CHECK(onCpu.advance(10).status == kCgBrokenDown);
}

TEST_CASE("Jacobi sweeps give the vectors of their CPU twin") {
  const test::ValidatedDevice device;
  if (!test::hasBuffersForSolvers(*device)) return;
  const PoissonSystem system = unevenSystem();
  const ScaledSystem scaled(system);
  const KernelTwins twins{system};
  const std::vector<double> residual = randomResidual(system.unknownCount());
  const std::vector<double> b = twins.scaled(residual);
  const VulkanJacobiKernel kernel(*device);
  const VulkanMatrix matrix = matrixOn(*device, scaled);
  for (uint32_t iterationCount : {1u, 2u, 7u}) {
    CAPTURE(iterationCount);
    const Buffer onDevice = vectorOn(*device, scaled.scaleResidual(residual, KernelTwins{system}.norm(residual)));
    VulkanJacobi jacobi(*device, kernel, matrix, onDevice);
    std::vector<double> y(b.size(), 0.0), before(b.size());
    for (uint32_t i = 0; i < iterationCount; ++i) {
      const std::vector<double> coupled = twins.coupled(y);
      for (size_t row = 0; row < y.size(); ++row) {
        before[row] = b[row] + coupled[row] - y[row];
        y[row] += before[row];
      }
    }
    CHECK(jacobi.advance(iterationCount) == doctest::Approx(std::sqrt(twins.squaredNorm(before))).epsilon(1e-5));
    CHECK(difference(jacobi.solution(), y) < 1e-5);
  }
}

TEST_CASE("a system that exceeds a limit of the device is refused") {
  DeviceFacts facts;
  facts.name = "Toy";
  facts.kind = DeviceKind::Cpu;
  facts.maxWorkgroupInvocations = facts.maxWorkgroupSize = 1024;
  facts.endsLongLoops = true;
  facts.maxStorageBufferRange = 128u << 20;
  facts.maxTexelBufferElements = 1u << 27;
  const auto fits = [&](uint64_t unknownCount, uint64_t tailCount, uint64_t longestRow) {
    try {
      requireSystemFits(facts, unknownCount, tailCount, longestRow);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::EquationLimit);
      CHECK(std::string(error.what()).find("Toy") != std::string::npos);
      return false;
    }
    return true;
  };
  CHECK(fits(4u << 20, 0, 3));
  CHECK_FALSE(fits((4u << 20) + 1, 0, 3));  // 32 bytes per row.
  CHECK(fits(1'000'000, 33'000'000, 50));
  CHECK_FALSE(fits(1'000'000, 36'000'000, 50));  // 137.3 MiB in one buffer.
  CHECK(fits(1000, 3000, 93));
  CHECK_FALSE(fits(4'000'000, 100, 1000));  // Loop iterations.
  facts.endsLongLoops = false;
  CHECK(fits(4'000'000, 100, 1000));
}

TEST_CASE("each specialization constant of the Poisson shaders has an id of its own") {
  CHECK(test::hasDistinctSpecializationIds(k_cg_product_comp));
  CHECK(test::hasDistinctSpecializationIds(k_cg_step_comp));
  CHECK(test::hasDistinctSpecializationIds(k_jacobi_sweep_comp));
}

TEST_CASE("every system has at least one workgroup and at most kMaxPoissonWorkgroupCount") {
  DeviceFacts facts;
  facts.kind = DeviceKind::Discrete;
  facts.maxWorkgroupInvocations = facts.maxWorkgroupSize = 1000;
  CHECK(choosePoissonGrid(facts, 1).workgroupCount == 1);
  CHECK(choosePoissonGrid(facts, 4'000'000'000u).workgroupCount == kMaxPoissonWorkgroupCount);
  CHECK(choosePoissonGrid(facts, 1).laneCount == 256);
  facts.maxWorkgroupInvocations = facts.maxWorkgroupSize = 200;
  CHECK(choosePoissonGrid(facts, 1).laneCount == 128);
}
