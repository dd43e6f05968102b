#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "dense_twin.h"
#include "fixtures.h"
#include "generate/shapes.h"
#include "poisson/cpu_cg.h"
#include "sample_problems.h"
#include "support/require_failure.h"
#include "support/test_device.h"

using namespace asdfvk;

namespace {

struct SolverUnderTest {
  std::string name;
  std::unique_ptr<PoissonSolver> solver;
  double minTolerance;  ///< Smallest tolerance that it reaches on the equations of these tests.
  bool isDevice;
};

/// Every solver, those on the device under validation, if it has the storage buffers for them.
class SolversUnderTest {
 public:
  SolversUnderTest() {
    const std::map<std::string_view, double> minTolerances{{"eigen", 1e-12}, {"cpu", 1e-12}, {"cg", 1e-10}};
    const bool hasBuffers = test::hasBuffersForSolvers(*device_);
    for (const Solver& solver : solverTable()) {
      if (solver.needsDevice && !hasBuffers) continue;
      const auto found = minTolerances.find(solver.name);
      solvers_.push_back({solver.name, makeSolver(solver.name, &*device_),
                          found == minTolerances.end() ? 1e-7 : found->second, solver.needsDevice});
    }
  }

  [[nodiscard]] auto begin() { return solvers_.begin(); }
  [[nodiscard]] auto end() { return solvers_.end(); }
  /// The order of the sums, which depends on the lanes of the device, decides whether float32 breaks down.
  [[nodiscard]] bool sumsAsTheCpu() const { return device_->facts().kind == DeviceKind::Cpu; }

 private:
  test::ValidatedDevice device_;
  std::vector<SolverUnderTest> solvers_;
};

struct Solved {
  SolverReport report;
  std::vector<double> solution;
};

Solved solve(SolverUnderTest& under, const Equation& equation, const SolverOptions& options,
             const RunControl& control = {}) {
  Solved solved;
  std::vector<double> values;
  solved.report =
      under.solver->onGraph(equation.graph, equation.weights)->solve(equation.problem(), options, values, control);
  for (const uint32_t face : equation.system.faces) solved.solution.push_back(values[face]);
  for (size_t face = 0; face < values.size(); ++face)
    if (std::isfinite(equation.constraints[face])) CHECK(values[face] == equation.constraints[face]);
  // A device that finishes in float32 measures its residual in float32, too.
  const double rounding = under.isDevice && !solved.report.finishedOnCpu ? 1e-6 : 0;
  const double residual = relativeResidual(equation.system, solved.solution);
  if (std::isfinite(residual)) CHECK(std::abs(solved.report.relativeResidual - residual) <= rounding + 1e-5 * residual);
  return solved;
}

Solved solveTightly(SolverUnderTest& under, const Equation& equation) {
  Solved solved = solve(under, equation, {.tolerance = under.minTolerance, .maxIterations = 200'000});
  CHECK(solved.report.converged);
  CHECK(solved.report.relativeResidual <= under.minTolerance);
  return solved;
}

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

/// A chain of 40 faces whose weights span ten decades: float32 conjugate gradients break down on it.
Equation unevenChain() {
  constexpr uint32_t kFaceCount = 40;
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  std::vector<double> weights;  // In the order of the arcs: each face's arc to the face before it comes first.
  Random random(3);
  for (uint32_t face = 1; face < kFaceCount; ++face) {
    edges.emplace_back(face - 1, face);
    weights.insert(weights.end(), 2, std::pow(10.0, 10 * random.real()));
  }
  const HandGraph hand(std::vector<Vec3d>(kFaceCount), edges);
  std::vector<double> values(kFaceCount, kNoValue);
  values.front() = 1;
  values.back() = 3;
  return {hand.graph, weights, values};
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

TEST_CASE("not converging is reported, not thrown") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(60, 30);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, equation, {.tolerance = 1e-6, .maxIterations = 1});
    CHECK_FALSE(report.converged);
    CHECK(report.iterations == 1);
    CHECK(report.relativeResidual > 1e-6);
    CHECK(solve(under, equation, {.tolerance = 1e-6, .maxIterations = 0}).report.iterations == 0);
  }
}

TEST_CASE("a tolerance of 0 ends with a small residual") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(10, 10);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, equation, {.tolerance = 0, .maxIterations = 5000});
    CHECK(report.relativeResidual < 1e-6);
  }
}

TEST_CASE("a right-hand side that overflows is reported as not converged, or solved in the unit of a device") {
  SolversUnderTest solvers;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  const std::vector<double> values{1e308, kNoValue, kNoValue, 1}, divergence{0, 1e308, 0, 0};
  const Equation equation = distanceEquation(hand.graph, hand.geometry, values, divergence);
  REQUIRE(std::isinf(equation.system.rightHandSide[0]));
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const Solved solved = solve(under, equation, {});
    CHECK(solved.report.converged == under.isDevice);
    if (under.isDevice) CHECK(solved.solution[0] == doctest::Approx(4.0 / 3 * 1e308).epsilon(1e-3));
  }
}

TEST_CASE("a solver stops on request") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(60, 30);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    std::stop_source source;
    int calls = 0;
    double last = 0;
    const RunControl control{source.get_token(), [&](double fraction) {
                               CHECK(fraction >= last);
                               CHECK(fraction <= 1);
                               last = fraction;
                               if (++calls == 2) source.request_stop();
                             }};
    bool cancelled = false;
    try {
      (void)solve(under, equation, {.tolerance = under.minTolerance}, control);
    } catch (const Error& error) {
      cancelled = error.kind() == ErrorKind::Cancelled;
    }
    CHECK(cancelled);
    CHECK(calls == 2);
    // The solver remains usable.
    CHECK(solve(under, equation, {}).report.converged);
  }
}

TEST_CASE("two runs give the same bits") {
  SolversUnderTest solvers;
  const Equation equation = torusEquation(60, 30), other = torusEquation(20, 10);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const Solved first = solve(under, equation, {});
    (void)solve(under, other, {});
    const Solved second = solve(under, equation, {});
    CHECK(first.report.iterations == second.report.iterations);
    CHECK(std::memcmp(first.solution.data(), second.solution.data(), first.solution.size() * sizeof(double)) == 0);
  }
}

TEST_CASE("solvers on the CPU give the same bits on any number of threads") {
  const Equation equation = torusEquation(160, 80);
  for (const Solver& solver : solverTable()) {
    if (solver.needsDevice) continue;
    std::vector<double> solutions[3];
    for (const size_t threadCount : {1, 2, 3}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
      std::vector<double>& solution = solutions[threadCount - 1];
      const std::unique_ptr<PoissonSolver> made = makeSolver(solver.name, nullptr);
      const std::unique_ptr<GraphSolver> onGraph = made->onGraph(equation.graph, equation.weights);
      CHECK(onGraph->solve(equation.problem(), {}, solution, {}).converged);
    }
    for (size_t i : {1, 2})
      CHECK(std::memcmp(solutions[0].data(), solutions[i].data(), solutions[0].size() * sizeof(double)) == 0);
  }
}

TEST_CASE("where float32 breaks down, on the CPU or on a device, double continues") {
  const Equation equation = unevenChain();
  const PoissonSystem& system = equation.system;
  const ScaledSystem scaled(system);
  std::vector<double> start(system.unknownCount(), system.constraintMean), residual(start.size());
  computeResidual(system, start, residual);
  CpuCg cg(scaled, scaled.scaleResidual(residual, residualNorm(system, residual)), 1e-6);
  REQUIRE(cg.advance(20'000).status == kCgBrokenDown);
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    if (under.name == "jacobi") continue;  // It needs too many iterations until it stagnates.
    CAPTURE(under.name);
    const SolverReport report = solve(under, equation, {.tolerance = 1e-6}).report;
    CHECK(report.converged);
    CHECK(report.relativeResidual <= 1e-6);
    if (under.name != "cg") CHECK_FALSE(report.finishedOnCpu);
    if (under.name == "cg" && solvers.sumsAsTheCpu()) CHECK(report.finishedOnCpu);
    CHECK_FALSE(solve(under, torusEquation(20, 10), {.tolerance = 1e-6}).report.finishedOnCpu);
  }
}

TEST_CASE("the iterations of the CPU count towards the maximum") {
  const Equation equation = unevenChain();
  SolversUnderTest solvers;
  const auto cg = std::find_if(solvers.begin(), solvers.end(), [](const auto& under) { return under.name == "cg"; });
  if (cg == solvers.end()) return;
  const uint32_t whole = solve(*cg, equation, {.tolerance = 1e-6}).report.iterations;
  const SolverReport report = solve(*cg, equation, {.tolerance = 1e-6, .maxIterations = whole - 1}).report;
  CHECK_FALSE(report.converged);
  CHECK(report.iterations == whole - 1);
  if (solvers.sumsAsTheCpu()) CHECK(report.finishedOnCpu);
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

TEST_CASE("with coincident faces float32 may not converge, but the residual does not grow") {
  SolversUnderTest solvers;
  for (uint64_t seed : {2, 3, 4}) {
    const SampleProblem problem("coincident faces", randomFaces(25, 300, seed));
    const Equation equation = distanceEquation(problem.graph, problem.geometry, problem.values);
    for (SolverUnderTest& under : solvers) {
      CAPTURE(under.name);
      const Solved solved = solve(under, equation, {.tolerance = 1e-6});
      CHECK(solved.report.relativeResidual <=
            relativeResidual(equation.system,
                             std::vector<double>(equation.system.unknownCount(), equation.system.constraintMean)));
      CHECK(*std::min_element(solved.solution.begin(), solved.solution.end()) > 0);
      CHECK(*std::max_element(solved.solution.begin(), solved.solution.end()) < 3);
    }
  }
}

TEST_CASE("solvers of a device that allows the least number of storage buffers are refused when they are made") {
  const Instance instance;
  const VkPhysicalDevice physical = instance.physicalDevices().front();
  DeviceFacts facts = describeDevice(physical);
  facts.maxStorageBuffersPerStage = 4;
  const Device device(physical, facts);
  for (const Solver& solver : solverTable()) {
    CAPTURE(solver.name);
    if (!solver.needsDevice)
      CHECK_NOTHROW((void)makeSolver(solver.name, &device));
    else
      test::requireFailure([&] { (void)makeSolver(solver.name, &device); }, ErrorCode::DeviceLimit, "has 4");
  }
}

TEST_CASE("the table of solvers has a default for a device and one for the CPU") {
  CHECK(defaultSolver(true).needsDevice);
  CHECK_FALSE(defaultSolver(false).needsDevice);
  const auto codeOf = [](std::string_view name) {
    try {
      (void)makeSolver(name, nullptr);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::Cancelled;
  };
  for (const Solver& solver : solverTable()) {
    CHECK(&findSolver(solver.name) == &solver);
    CHECK((codeOf(solver.name) == ErrorCode::NoDeviceForKernel) == solver.needsDevice);
  }
  CHECK(codeOf("fastest") == ErrorCode::UnknownName);
}

TEST_CASE("a solver starts from the first guess") {
  SolversUnderTest solvers;
  const SampleProblem problem("torus", torus(14, 10));
  const std::vector<double> weights = featureWeights(arcAngles(problem.graph, problem.geometry));
  const DenseTwin twin(problem.graph, weights, problem.values, {});
  std::vector<double> guess(problem.values.size(), 1.25);
  const auto build = [&] { return Equation(problem.graph, weights, problem.values, {}, guess); };
  const Equation away = build();
  for (size_t i = 0; i < twin.faces.size(); ++i)
    guess[static_cast<size_t>(twin.faces[i])] = twin.solution[static_cast<Eigen::Index>(i)];
  const Equation there = build();
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    CHECK(solve(under, away, {.tolerance = 1e-6, .maxIterations = 0}).solution ==
          std::vector<double>(away.system.unknownCount(), 1.25));
    const Solved solved = solve(under, there, {.tolerance = 1e-10});
    CHECK(solved.report.converged);
    CHECK(solved.report.iterations == 0);
    CHECK(solved.solution == there.system.firstGuess);
  }
}
