#include <doctest/doctest.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "dense_twin.h"
#include "generate/shapes.h"
#include "sample_problems.h"
#include "solvers_under_test.h"
#include "support/require_failure.h"
#include "support/test_device.h"

using namespace asdfvk;

namespace {

std::vector<double> directSolution(const PoissonSystem& system) {
  const auto size = static_cast<Eigen::Index>(system.unknownCount());
  std::vector<Eigen::Triplet<double>> entries;
  for (uint32_t row = 0; row < system.unknownCount(); ++row) {
    entries.emplace_back(row, row, system.diagonal[row]);
    for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i)
      entries.emplace_back(row, system.columns[i], system.entries[i]);
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  const Eigen::VectorXd x = factors.solve(Eigen::Map<const Eigen::VectorXd>(system.rightHandSide.data(), size));
  return {x.data(), x.data() + x.size()};
}

double largestDifference(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double each = std::abs(a[i] - b[i]);
    if (!(each <= largest)) largest = each;  // NaN too
  }
  return largest;
}

}  // namespace

TEST_CASE("a chain between two constraints is a straight line") {
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solveTightly(under, chainEquation(41, 1, 3));
    for (size_t i = 0; i < solution.size(); ++i)
      CHECK(solution[i] == doctest::Approx(1 + 2 * static_cast<double>(i + 1) / 40).epsilon(1000 * under.minTolerance));
  }
}

TEST_CASE("a single unknown is the weighted mean of its neighbours") {
  SolversUnderTest solvers;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 1}, {1, 2}});
  const Equation equation = distanceEquation(hand.graph, hand.geometry, std::vector<double>{5, kNoValue, 8});
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    CHECK(solveTightly(under, equation).solution[0] == doctest::Approx(6));
  }
}

TEST_CASE("a system without unknowns converges in no iteration") {
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, chainEquation(2, 1, 3), {});
    CHECK(report.iterations == 0);
    CHECK(report.converged);
    CHECK(report.relativeResidual == 0);
  }
}

TEST_CASE("constraints of 0 give exactly 0") {
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, chainEquation(5, 0, 0), {});
    CHECK(solution == std::vector<double>{0, 0, 0});
    CHECK(report.converged);
  }
}

TEST_CASE("a right-hand side of 0 gives 0, not the mean of other constraints") {
  SolversUnderTest solvers;
  // Face 2 is a constraint without an unknown neighbour.
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {9, 0, 0}}, {{0, 1}});
  const Equation equation = distanceEquation(hand.graph, hand.geometry, std::vector<double>{0, kNoValue, 8});
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    CHECK(solve(under, equation, {}).solution == std::vector<double>{0});
  }
}

TEST_CASE("a divergence bends a chain as computed by hand") {
  SolversUnderTest solvers;
  // Two unknowns between 0 and 0, unit distances, divergence -1 on the first: 2a - b = -1, 2b - a = 0.
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  const Equation equation = distanceEquation(hand.graph, hand.geometry, std::vector<double>{0, kNoValue, kNoValue, 0},
                                             std::vector<double>{0, -1, 0, 0});
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solveTightly(under, equation);
    CHECK(solution[0] == doctest::Approx(-2.0 / 3));
    CHECK(solution[1] == doctest::Approx(-1.0 / 3));
  }
}

TEST_CASE("components with a constraint each are solved separately") {
  SolversUnderTest solvers;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 0, 0}, {10, 0, 0}, {20, 0, 0}}, {{0, 1}, {1, 2}, {3, 4}});
  const Equation equation =
      distanceEquation(hand.graph, hand.geometry, std::vector<double>{1, kNoValue, kNoValue, kNoValue, 700, kNoValue});
  CHECK(equation.system.faces == std::vector<uint32_t>{1, 2, 3});
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solveTightly(under, equation);
    CHECK(solution[0] == doctest::Approx(1).epsilon(1e-3));
    CHECK(solution[1] == doctest::Approx(1).epsilon(1e-3));
    CHECK(solution[2] == doctest::Approx(700));
  }
}

TEST_CASE("a torus has the solution of a direct factorisation") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(60, 30);
  const std::vector<double> direct = directSolution(equation.system);
  REQUIRE(relativeResidual(equation.system, direct) < 1e-13);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    // Faces far from a constraint magnify the residual: 100 is twice the observed factor.
    CHECK(largestDifference(solveTightly(under, equation).solution, direct) < 100 * under.minTolerance);
  }
}

TEST_CASE("without a divergence no value leaves the range of the constraints") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(80, 40);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solveTightly(under, equation);
    CHECK(*std::min_element(solution.begin(), solution.end()) >= 1 - 1e-5);
    CHECK(*std::max_element(solution.begin(), solution.end()) <= 2 + 1e-5);
  }
}

TEST_CASE("the relative result does not depend on the unit of the values") {
  SolversUnderTest solvers;
  const std::vector<double> expected = directSolution(torusSystem(30, 20));
  for (double unit : {0x1p-400, 0x1p-60, 0x1p60, 0x1p400}) {
    const Equation equation = torusEquation(30, 20, unit);
    for (SolverUnderTest& under : solvers) {
      CAPTURE(under.name);
      CAPTURE(unit);
      std::vector<double> solution = solveTightly(under, equation).solution;
      for (double& entry : solution) entry /= unit;
      CHECK(largestDifference(solution, expected) < 1e-3);
    }
  }
}

TEST_CASE("coincident barycentres do not prevent convergence") {
  SolversUnderTest solvers;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  const Equation equation = distanceEquation(hand.graph, hand.geometry, std::vector<double>{1, kNoValue, kNoValue, 3});
  for (SolverUnderTest& under : solvers) {
    // A Jacobi iteration reduces the error of such a pair by a billionth.
    if (under.name == "jacobi") continue;
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, equation, {.tolerance = 1e-5});
    CHECK(report.converged);
    CHECK(solution[0] == doctest::Approx(2).epsilon(1e-3));
    CHECK(solution[1] == doctest::Approx(2).epsilon(1e-3));
  }
}

TEST_CASE("a finely meshed patch does not hide errors elsewhere") {
  // Patches shrunk by a factor of a million: the weights 1 / distance span six orders of magnitude.
  Mesh mesh = generateShape("torus", 6000).mesh;
  std::vector<Vec3d> centres;
  for (size_t i = 0; i < 10; ++i) centres.push_back(mesh.vertices[i * mesh.vertices.size() / 10]);
  for (Vec3d& v : mesh.vertices)
    for (const Vec3d& centre : centres)
      if (length(v - centre) < 0.1) v = centre + (v - centre) * 1e-6;
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  std::vector<double> values(mesh.faceCount(), kNoValue);
  Random random(3);
  for (size_t i = 0; i < 300; ++i) {
    const uint32_t face = random.index(mesh.faceCount());
    values[face] = 1 + geometry.barycentres[face].x;
  }
  const Equation equation = distanceEquation(buildDualGraph(mesh), geometry, values);
  const std::vector<double> direct = directSolution(equation.system);
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    if (under.name == "jacobi") continue;  // It needs a thousand times as many iterations.
    const Solved solved = solve(under, equation, {});
    CHECK(solved.report.converged);
    double sum = 0;
    for (size_t i = 0; i < direct.size(); ++i) sum += std::abs(solved.solution[i] - direct[i]);
    // The range is 2.6. A device measures its residual in float32.
    CHECK(sum / static_cast<double>(direct.size()) < (under.isDevice ? 0.02 : 0.01));
  }
}

TEST_CASE("the solution is that of dense algebra, for all weights") {
  SolversUnderTest solvers;
  forEachSetting([&](const Setting& setting) {
    const auto& [problem, kind, weights] = setting;
    // Weights of its coincident faces are a billion times larger than others; see the next test.
    if (kind == ArcWeights::Distance && problem.name == "dense random faces") return;
    const Equation equation(problem.graph, weights, problem.values);
    const DenseTwin twin(problem.graph, weights, problem.values, {});
    const double errorOverResidual = twin.largestErrorOverResidual();
    for (SolverUnderTest& under : solvers) {
      // Thousands of iterations if many faces share an edge.
      if (under.name == "jacobi" && !problem.isManifold) continue;
      CAPTURE(under.name);
      const auto [report, solution] = solveTightly(under, equation);
      const double bound = 1e-10 + under.minTolerance * errorOverResidual;
      CHECK(largestDifference(solution, {twin.solution.data(), solution.size()}) < bound);
      CHECK(*std::min_element(solution.begin(), solution.end()) >= 1 - bound);
      CHECK(*std::max_element(solution.begin(), solution.end()) <= 2 + bound);
    }
  });
}

TEST_CASE("solvers of a device that allows the least number of storage buffers are refused when they are made") {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  DeviceFacts facts = describeDevice(physical);
  facts.maxStorageBuffersPerStage = 4;
  const Device device(physical, facts);
  for (const Solver& solver : solverTable()) {
    CAPTURE(nameOf(solver));
    if (!solver.needsDevice)
      CHECK_NOTHROW((void)makeSolver(solver.choice, &device));
    else
      test::requireFailure([&] { (void)makeSolver(solver.choice, &device); }, ErrorCode::DeviceLimit, "has 4");
  }
}

TEST_CASE("the table of solvers has a default for a device and one for the CPU") {
  CHECK(defaultSolver(true).needsDevice);
  CHECK_FALSE(defaultSolver(false).needsDevice);
  const auto codeOf = [](SolverChoice choice) {
    try {
      (void)makeSolver(choice, nullptr);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::Cancelled;
  };
  for (const Solver& solver : solverTable()) {
    CHECK(&solverOf(solver.choice) == &solver);
    CHECK((codeOf(solver.choice) == ErrorCode::NoDeviceForKernel) == solver.needsDevice);
  }
}
