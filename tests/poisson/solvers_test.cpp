#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstring>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "dense_twin.h"
#include "fixtures.h"
#include "generate/shapes.h"
#include "poisson/cpu_cg.h"
#include "sample_problems.h"
#include "solvers_under_test.h"

using namespace asdfvk;

namespace {

struct Solved {
  SolverReport report;
  std::vector<double> solution;
};

Solved solve(SolverUnderTest& under, const PoissonSystem& system, const SolverOptions& options) {
  Solved solved;
  solved.solution.assign(system.unknownCount(), -12345);
  solved.report = under.solver->solve(system, options, solved.solution, {});
  CHECK(solved.report.name == under.name);
  CHECK(solved.report.relativeResidual == doctest::Approx(relativeResidual(system, solved.solution)));
  return solved;
}

Solved solveTightly(SolverUnderTest& under, const PoissonSystem& system) {
  Solved solved = solve(under, system, {.tolerance = under.tightestTolerance, .maxIterations = 200'000});
  CHECK(solved.report.converged);
  CHECK(solved.report.relativeResidual <= under.tightestTolerance);
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
PoissonSystem unevenChain() {
  constexpr uint32_t kFaceCount = 40;
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  std::vector<double> weights;  // In the order of the arcs: of each face the one to the face before it comes first.
  Random random(3);
  for (uint32_t face = 1; face < kFaceCount; ++face) {
    edges.emplace_back(face - 1, face);
    weights.insert(weights.end(), 2, std::pow(10.0, 10 * random.real()));
  }
  const HandGraph hand(std::vector<Vec3d>(kFaceCount), edges);
  std::vector<double> values(kFaceCount, kNoValue);
  values.front() = 1;
  values.back() = 3;
  return buildPoissonSystem(hand.graph, weights, values, {});
}

double largestDifference(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

TEST_CASE("a chain between two known ends is a straight line") {
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solveTightly(under, chain(41, 1, 3));
    for (size_t i = 0; i < solution.size(); ++i)
      CHECK(solution[i] ==
            doctest::Approx(1 + 2 * static_cast<double>(i + 1) / 40).epsilon(1000 * under.tightestTolerance));
  }
}

TEST_CASE("a single unknown is the weighted mean of its neighbours") {
  SolversUnderTest solvers;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 1}, {1, 2}});
  const PoissonSystem system = distanceSystem(hand.graph, hand.geometry, std::vector<double>{5, kNoValue, 8});
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    CHECK(solveTightly(under, system).solution[0] == doctest::Approx(6));
  }
}

TEST_CASE("no unknown takes no iteration and is converged") {
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, chain(2, 1, 3), {});
    CHECK(report.iterations == 0);
    CHECK(report.converged);
    CHECK(report.relativeResidual == 0);
  }
}

TEST_CASE("known values of 0 give 0 exactly") {
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, chain(5, 0, 0), {});
    CHECK(solution == std::vector<double>{0, 0, 0});
    CHECK(report.converged);
  }
}

TEST_CASE("a right-hand side of 0 beside other known values gives 0, not their mean") {
  SolversUnderTest solvers;
  // Face 2 is known, but joined to no unknown.
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {9, 0, 0}}, {{0, 1}});
  const PoissonSystem system = distanceSystem(hand.graph, hand.geometry, std::vector<double>{0, kNoValue, 8});
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    CHECK(solve(under, system, {}).solution == std::vector<double>{0});
  }
}

TEST_CASE("the guidance term bends a chain by what is worked out by hand") {
  SolversUnderTest solvers;
  // Two unknowns between 0 and 0, unit distances, divergence -1 on the first: 2a - b = -1, 2b - a = 0.
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  const PoissonSystem system = distanceSystem(hand.graph, hand.geometry, std::vector<double>{0, kNoValue, kNoValue, 0},
                                              std::vector<double>{0, -1, 0, 0});
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solveTightly(under, system);
    CHECK(solution[0] == doctest::Approx(-2.0 / 3));
    CHECK(solution[1] == doctest::Approx(-1.0 / 3));
  }
}

TEST_CASE("components with a known face each are solved on their own") {
  SolversUnderTest solvers;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 0, 0}, {10, 0, 0}, {20, 0, 0}}, {{0, 1}, {1, 2}, {3, 4}});
  const PoissonSystem system =
      distanceSystem(hand.graph, hand.geometry, std::vector<double>{1, kNoValue, kNoValue, kNoValue, 700, kNoValue});
  CHECK(system.faces == std::vector<uint32_t>{1, 2, 3});
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solveTightly(under, system);
    CHECK(solution[0] == doctest::Approx(1).epsilon(1e-3));
    CHECK(solution[1] == doctest::Approx(1).epsilon(1e-3));
    CHECK(solution[2] == doctest::Approx(700));
  }
}

TEST_CASE("a torus comes out as a direct factorisation solves it") {
  SolversUnderTest solvers;
  const PoissonSystem system = torusSystem(60, 30);
  const std::vector<double> direct = directSolution(system);
  REQUIRE(relativeResidual(system, direct) < 1e-13);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    // Faces far from a seed magnify the residual; a hundredfold is twice what was seen.
    CHECK(largestDifference(solveTightly(under, system).solution, direct) < 100 * under.tightestTolerance);
  }
}

TEST_CASE("without guidance no value leaves the range of the known ones") {
  SolversUnderTest solvers;
  const PoissonSystem system = torusSystem(80, 40);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solveTightly(under, system);
    CHECK(*std::min_element(solution.begin(), solution.end()) >= 1 - 1e-5);
    CHECK(*std::max_element(solution.begin(), solution.end()) <= 2 + 1e-5);
  }
}

TEST_CASE("the unit of the values does not matter") {
  SolversUnderTest solvers;
  const std::vector<double> expected = directSolution(torusSystem(30, 20));
  for (double unit : {0x1p-400, 0x1p-60, 0x1p60, 0x1p400}) {
    const PoissonSystem system = torusSystem(30, 20, unit);
    for (SolverUnderTest& under : solvers) {
      CAPTURE(under.name);
      CAPTURE(unit);
      std::vector<double> solution = solveTightly(under, system).solution;
      for (double& entry : solution) entry /= unit;
      CHECK(largestDifference(solution, expected) < 1e-3);
    }
  }
}

TEST_CASE("coincident barycentres beside ordinary ones do not keep a solver from its tolerance") {
  SolversUnderTest solvers;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  const PoissonSystem system = distanceSystem(hand.graph, hand.geometry, std::vector<double>{1, kNoValue, kNoValue, 3});
  for (SolverUnderTest& under : solvers) {
    // A plain Jacobi iteration wins a billionth a step on such a pair.
    if (under.name == "jacobi") continue;
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, system, {.tolerance = 1e-5});
    CHECK(report.converged);
    CHECK(solution[0] == doctest::Approx(2).epsilon(1e-3));
    CHECK(solution[1] == doctest::Approx(2).epsilon(1e-3));
  }
}

TEST_CASE("not converging is reported, not thrown") {
  SolversUnderTest solvers;
  const PoissonSystem system = torusSystem(60, 30);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, system, {.tolerance = 1e-6, .maxIterations = 1});
    CHECK_FALSE(report.converged);
    CHECK(report.iterations == 1);
    CHECK(report.relativeResidual > 1e-6);
    CHECK(solve(under, system, {.tolerance = 1e-6, .maxIterations = 0}).report.iterations == 0);
  }
}

TEST_CASE("a tolerance of 0 ends, with the best there is") {
  SolversUnderTest solvers;
  const PoissonSystem system = torusSystem(10, 10);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const auto [report, solution] = solve(under, system, {.tolerance = 0, .maxIterations = 5000});
    CHECK(report.relativeResidual < 1e-6);
  }
}

TEST_CASE("a right-hand side that overflows is reported as not converged") {
  SolversUnderTest solvers;
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  const std::vector<double> values{1e308, kNoValue, kNoValue, 1}, divergence{0, 1e308, 0, 0};
  const PoissonSystem system = distanceSystem(hand.graph, hand.geometry, values, divergence);
  REQUIRE(std::isinf(system.rightHandSide[0]));
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    std::vector<double> solution(system.unknownCount());
    CHECK_FALSE(under.solver->solve(system, {}, solution, {}).converged);
  }
}

TEST_CASE("a solver stops when it is asked to") {
  SolversUnderTest solvers;
  const PoissonSystem system = torusSystem(60, 30);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    std::vector<double> solution(system.unknownCount());
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
      (void)under.solver->solve(system, {.tolerance = under.tightestTolerance}, solution, control);
    } catch (const Error& error) {
      cancelled = error.kind() == ErrorKind::Cancelled;
    }
    CHECK(cancelled);
    CHECK(calls == 2);
    // And works again afterwards.
    CHECK(solve(under, system, {}).report.converged);
  }
}

TEST_CASE("two runs give the same bits") {
  SolversUnderTest solvers;
  const PoissonSystem system = torusSystem(60, 30), other = torusSystem(20, 10);
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    const Solved first = solve(under, system, {});
    (void)solve(under, other, {});
    const Solved second = solve(under, system, {});
    CHECK(first.report.iterations == second.report.iterations);
    CHECK(std::memcmp(first.solution.data(), second.solution.data(), first.solution.size() * sizeof(double)) == 0);
  }
}

TEST_CASE("solvers on the CPU give the same bits on any number of threads") {
  const PoissonSystem system = torusSystem(160, 80);
  for (const auto& make : {makeCpuCgSolver, makeEigenSolver}) {
    std::vector<double> solutions[3];
    for (const size_t threadCount : {1, 2, 3}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
      std::vector<double>& solution = solutions[threadCount - 1];
      solution.resize(system.unknownCount());
      CHECK(make()->solve(system, {}, solution, {}).converged);
    }
    for (size_t i : {1, 2})
      CHECK(std::memcmp(solutions[0].data(), solutions[i].data(), solutions[0].size() * sizeof(double)) == 0);
  }
}

TEST_CASE("where float32 gives up, on the CPU or a device, double carries on") {
  const PoissonSystem system = unevenChain();
  const ScaledSystem scaled(system);
  std::vector<double> start(system.unknownCount(), system.knownMean), residual(start.size());
  computeResidual(system, start, residual);
  CpuCg cg(scaled, scaled.scaleResidual(residual, residualNorm(system, residual)), 1e-6);
  REQUIRE(cg.advance(20'000).status == kCgBrokenDown);
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    if (under.name == "jacobi") continue;  // Nobody finishes what is there to be compared with.
    CAPTURE(under.name);
    const SolverReport report = solve(under, system, {.tolerance = 1e-6}).report;
    CHECK(report.converged);
    CHECK(report.relativeResidual <= 1e-6);
    CHECK(report.finishedOnCpu == (under.name == "cg"));
    CHECK_FALSE(solve(under, torusSystem(20, 10), {.tolerance = 1e-6}).report.finishedOnCpu);
  }
}

TEST_CASE("what the CPU finishes is within the iterations that were granted") {
  const PoissonSystem system = unevenChain();
  SolversUnderTest solvers;
  const auto cg = std::find_if(solvers.begin(), solvers.end(), [](const auto& under) { return under.name == "cg"; });
  REQUIRE(cg != solvers.end());
  const uint32_t whole = solve(*cg, system, {.tolerance = 1e-6}).report.iterations;
  const SolverReport report = solve(*cg, system, {.tolerance = 1e-6, .maxIterations = whole - 1}).report;
  CHECK_FALSE(report.converged);
  CHECK(report.iterations == whole - 1);
  CHECK(report.finishedOnCpu);
}

TEST_CASE("a finely meshed patch does not hide what is unsolved elsewhere") {
  // Patches of vertices are drawn together to a millionth, so that weights 1 / distance span six orders of magnitude.
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
  const PoissonSystem system = distanceSystem(buildDualGraph(mesh), geometry, values);
  const std::vector<double> direct = directSolution(system);
  SolversUnderTest solvers;
  for (SolverUnderTest& under : solvers) {
    if (under.name == "jacobi") continue;  // It needs a thousand times the iterations here.
    const Solved solved = solve(under, system, {});
    CHECK(solved.report.converged);
    double sum = 0;
    for (size_t i = 0; i < direct.size(); ++i) sum += std::abs(solved.solution[i] - direct[i]);
    CHECK(sum / static_cast<double>(direct.size()) < 0.01);  // of a range of 2.6
  }
}

TEST_CASE("systems with any weights come out as dense algebra solves them") {
  SolversUnderTest solvers;
  forEachSetting([&](const Setting& setting) {
    const auto& [problem, kind, weights] = setting;
    // Its coincident faces tie each other a billion times stronger than others; see the test after this.
    if (kind == ArcWeights::Distance && problem.name == "dense random faces") return;
    const PoissonSystem system = buildPoissonSystem(problem.graph, weights, problem.values, {});
    const DenseTwin twin(problem.graph, weights, problem.values, {});
    for (SolverUnderTest& under : solvers) {
      // Thousands of iterations where edges have many faces.
      if (under.name == "jacobi" && !problem.isManifold) continue;
      CAPTURE(under.name);
      const auto [report, solution] = solveTightly(under, system);
      const double bound = 1e-10 + under.tightestTolerance * twin.largestErrorOverResidual();
      CHECK(largestDifference(solution, {twin.solution.data(), solution.size()}) < bound);
      CHECK(*std::min_element(solution.begin(), solution.end()) >= 1 - bound);
      CHECK(*std::max_element(solution.begin(), solution.end()) <= 2 + bound);
    }
  });
}

TEST_CASE("coincident faces may keep float32 from converging, but nothing is made worse by trying") {
  SolversUnderTest solvers;
  for (uint64_t seed : {2, 3, 4}) {
    const SampleProblem problem("coincident faces", randomFaces(25, 300, seed));
    const PoissonSystem system = distanceSystem(problem.graph, problem.geometry, problem.values);
    for (SolverUnderTest& under : solvers) {
      CAPTURE(under.name);
      const Solved solved = solve(under, system, {.tolerance = 1e-6});
      CHECK(solved.report.relativeResidual <=
            relativeResidual(system, std::vector<double>(system.unknownCount(), system.knownMean)));
      CHECK(*std::min_element(solved.solution.begin(), solved.solution.end()) > 0);
      CHECK(*std::max_element(solved.solution.begin(), solved.solution.end()) < 3);
    }
  }
}

TEST_CASE("a solver starts at the first guess") {
  SolversUnderTest solvers;
  const SampleProblem problem("torus", torus(14, 10));
  const std::vector<double> weights = arcWeights(ArcWeights::Feature, problem.graph, problem.geometry);
  const DenseTwin twin(problem.graph, weights, problem.values, {});
  std::vector<double> guess(problem.values.size(), 1.25);
  const auto build = [&] {
    return buildPoissonSystem(problem.graph, weights, problem.values, {}, {.firstGuess = guess});
  };
  const PoissonSystem away = build();
  for (size_t i = 0; i < twin.faces.size(); ++i)
    guess[static_cast<size_t>(twin.faces[i])] = twin.solution[static_cast<Eigen::Index>(i)];
  const PoissonSystem there = build();
  for (SolverUnderTest& under : solvers) {
    CAPTURE(under.name);
    CHECK(solve(under, away, {.tolerance = 1e-6, .maxIterations = 0}).solution ==
          std::vector<double>(away.unknownCount(), 1.25));
    const Solved solved = solve(under, there, {.tolerance = 1e-10});
    CHECK(solved.report.converged);
    CHECK(solved.report.iterations == 0);
    CHECK(solved.solution == there.firstGuess);
  }
}
