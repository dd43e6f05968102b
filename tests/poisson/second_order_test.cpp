#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dense_twin.h"
#include "mesh/components.h"
#include "poisson/divergence.h"
#include "poisson/jacobi_damping.h"
#include "poisson/scaled_system.h"
#include "sample_problems.h"

using namespace asdfvk;

namespace {

/// The system as a dense matrix.
Eigen::MatrixXd denseMatrix(const PoissonSystem& system) {
  const Eigen::Index size = system.unknownCount();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (uint32_t row = 0; row < system.unknownCount(); ++row) {
    matrix(row, row) = system.diagonal[row];
    for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i)
      matrix(row, system.columns[i]) += system.entries[i];
  }
  return matrix;
}

std::vector<double> randomField(size_t size) {
  Random random(9);
  std::vector<double> field(size);
  for (double& entry : field) entry = 10 * (random.real() - 0.5);
  return field;
}

/// A row of `faceCount` faces, all weights 1.
PoissonSystem rowOfFaces(const std::vector<double>& values, const std::vector<double>& divergence, double beta) {
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (uint32_t f = 1; f < values.size(); ++f) edges.emplace_back(f - 1, f);
  const HandGraph hand(std::vector<Vec3d>(values.size()), edges);
  return buildPoissonSystem(hand.graph, arcWeights(ArcWeightKind::Uniform, hand.graph, hand.geometry), values,
                            divergence, {.secondOrder = beta});
}

template <typename Vector>
bool sameBits(const Vector& a, const Vector& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

}  // namespace

TEST_CASE("a row of three faces has the entries worked out by hand, a known value two arcs away included") {
  // L = [1 -1 0; -1 2 -1; 0 -1 1], D = (1, 2, 1): the last row of L + 3 L D^-1 L is (1.5, -7, 5.5).
  const PoissonSystem system = rowOfFaces({2, 3, kNoValue}, {}, 3);
  CHECK(system.diagonal[0] == doctest::Approx(5.5));
  CHECK(system.rightHandSide[0] == doctest::Approx(7 * 3 - 1.5 * 2));
  // The last row of I + 3 L D^-1 is (0, -1.5, 4).
  const PoissonSystem guided = rowOfFaces({2, 3, kNoValue}, {100, 0.5, 0.25}, 3);
  CHECK(guided.rightHandSide[0] == doctest::Approx(7 * 3 - 1.5 * 2 - 1.5 * 0.5 + 4 * 0.25));
}

TEST_CASE("the second order carries a slope on beyond the range of the known values, the first does not") {
  const auto last = [](const PoissonSystem& system) { return system.rightHandSide[0] / system.diagonal[0]; };
  CHECK(last(rowOfFaces({0, 1, kNoValue}, {}, 0)) == 1);
  CHECK(last(rowOfFaces({0, 1, kNoValue}, {}, 3)) == doctest::Approx(1 + 1.5 / 5.5));
}

TEST_CASE("matrix and right-hand side are those of dense algebra, with any weights and order") {
  forEachSetting([&](const Setting& setting) {
    const auto& [problem, kind, beta, weights] = setting;
    std::vector<double> divergence = randomField(problem.values.size());
    divergence[3] = kNoValue;
    const PoissonSystem system =
        buildPoissonSystem(problem.graph, weights, problem.values, divergence, {.secondOrder = beta});
    const DenseTwin twin(problem.graph, weights, problem.values, divergence, beta);
    REQUIRE(std::equal(system.faces.begin(), system.faces.end(), twin.faces.begin(), twin.faces.end()));
    REQUIRE(system.unknownCount() > 40);
    REQUIRE(system.unknownCount() < problem.values.size());
    const Eigen::MatrixXd matrix = denseMatrix(system);
    const auto scale = twin.matrix.diagonal().array();
    CHECK(((matrix - twin.matrix).array().colwise() / scale).abs().maxCoeff() < 1e-14);
    const Eigen::Map<const Eigen::VectorXd> b(system.rightHandSide.data(), matrix.rows());
    CHECK(((b - twin.rightHandSide).array() / scale).abs().maxCoeff() <
          1e-14 * (1 + (twin.rightHandSide.array() / scale).abs().maxCoeff()));
    // Conjugate gradients want this to the bit.
    CHECK(matrix == matrix.transpose());
    for (uint32_t row = 0; row < system.unknownCount(); ++row)
      CHECK(std::adjacent_find(system.columns.begin() + system.rowOffsets[row],
                               system.columns.begin() + system.rowOffsets[row + 1],
                               std::greater_equal<>()) == system.columns.begin() + system.rowOffsets[row + 1]);
    if (beta == 0) CHECK(std::all_of(system.entries.begin(), system.entries.end(), [](double e) { return e < 0; }));
  });
}

TEST_CASE("guided by a field that the known values agree with, the field is the solution") {
  forEachSetting([&](const Setting& setting) {
    const auto& [problem, kind, beta, weights] = setting;
    const std::vector<double> field = randomField(problem.values.size());
    std::vector<double> values = problem.values;
    for (size_t f = 0; f < values.size(); ++f)
      if (std::isfinite(values[f])) values[f] = field[f];
    const PoissonSystem system =
        buildPoissonSystem(problem.graph, weights, values, divergenceOf(problem.graph, weights, field),
                           {.secondOrder = beta, .firstGuess = field});
    CHECK(relativeResidual(system, system.firstGuess) < 1e-13);
    const Eigen::VectorXd solution = denseMatrix(system).ldlt().solve(
        Eigen::Map<const Eigen::VectorXd>(system.rightHandSide.data(), system.unknownCount()));
    for (uint32_t i = 0; i < system.unknownCount(); ++i)
      CHECK(solution[i] == doctest::Approx(field[system.faces[i]]).epsilon(1e-6).scale(1));
  });
}

TEST_CASE("on a manifold mesh a row has at most nine entries beside its diagonal") {
  const SampleProblem problem("torus", torus(30, 20));
  const PoissonSystem system =
      buildPoissonSystem(problem.graph, arcWeights(ArcWeightKind::Uniform, problem.graph, problem.geometry),
                         problem.values, {}, {.secondOrder = 3});
  CHECK(ScaledSystem(system).longestRow() == 9);
}

TEST_CASE("a face of many neighbours does not bend, so that no input makes the rows explode") {
  // All faces over 16 vertices: 39 neighbours each, and every face within two arcs of 300 others.
  Mesh mesh;
  Random random(1);
  for (uint32_t i = 0; i < 16; ++i) {
    mesh.vertices.push_back({random.real(), random.real(), random.real()});
    for (uint32_t j = 0; j < i; ++j)
      for (uint32_t k = 0; k < j; ++k) mesh.faces.push_back({i, j, k});
  }
  const SampleProblem problem("all faces", mesh);
  const std::vector<double> weights = arcWeights(ArcWeightKind::Uniform, problem.graph, problem.geometry);
  const PoissonSystem first = buildPoissonSystem(problem.graph, weights, problem.values, {});
  const PoissonSystem second = buildPoissonSystem(problem.graph, weights, problem.values, {}, {.secondOrder = 3});
  CHECK(second.entries == first.entries);
  CHECK(second.columns == first.columns);
  CHECK(second.diagonal == first.diagonal);
  CHECK(second.rightHandSide == first.rightHandSide);
}

TEST_CASE("tiny and huge units change the entries of the second order by their factor only") {
  const SampleProblem problem("torus", torus(14, 10));
  const auto build = [&](double unit) {
    FaceGeometry geometry = problem.geometry;
    for (Vec3d& p : geometry.barycentres) p = p * unit;
    geometry.bounds = {};
    for (const Vec3d& p : geometry.barycentres) geometry.bounds.add(p);
    return buildPoissonSystem(problem.graph, arcWeights(ArcWeightKind::Distance, problem.graph, geometry),
                              problem.values, {}, {.secondOrder = 3});
  };
  const PoissonSystem reference = build(1);
  for (double unit : {0x1p-800, 0x1p800}) {
    const PoissonSystem system = build(unit);
    for (size_t i = 0; i < system.entries.size(); ++i)
      CHECK(system.entries[i] * unit == doctest::Approx(reference.entries[i]).scale(1e-6));
    for (size_t i = 0; i < system.diagonal.size(); ++i)
      CHECK(system.diagonal[i] * unit == doctest::Approx(reference.diagonal[i]));
  }
}

TEST_CASE("weights, divergence and system have the same bits on any number of threads") {
  const SampleProblem problem("torus", torus(160, 80));
  const std::vector<double> field = randomField(problem.values.size());
  for (ArcWeightKind kind : kArcWeightKinds) {
    std::vector<std::vector<double>> numbers[3];
    for (const size_t threadCount : {1, 2, 3}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
      const std::vector<double> weights = arcWeights(kind, problem.graph, problem.geometry);
      const std::vector<double> divergence = divergenceOf(problem.graph, weights, field);
      PoissonSystem system = buildPoissonSystem(problem.graph, weights, problem.values, divergence, {.secondOrder = 3});
      numbers[threadCount - 1] = {weights, divergence};
      for (const auto& ofSystem : {system.entries, system.diagonal, system.rightHandSide})
        numbers[threadCount - 1].emplace_back(ofSystem.begin(), ofSystem.end());
    }
    for (size_t i = 0; i < numbers[0].size(); ++i) {
      CHECK(sameBits(numbers[0][i], numbers[1][i]));
      CHECK(sameBits(numbers[0][i], numbers[2][i]));
    }
  }
}

TEST_CASE("a first guess is taken where it is finite, else the mean of the known values stands in") {
  const PoissonSystem plain = rowOfFaces({2, kNoValue, kNoValue, 4}, {}, 0);
  CHECK(plain.firstGuess.empty());
  const HandGraph hand(std::vector<Vec3d>(4), {{0, 1}, {1, 2}, {2, 3}});
  const PoissonSystem system =
      buildPoissonSystem(hand.graph, std::vector<double>(6, 1.0), std::vector<double>{2, kNoValue, kNoValue, 4}, {},
                         {.firstGuess = std::vector<double>{9, kNoValue, 7, 9}});
  CHECK(system.firstGuess == std::vector<double>{3, 7});
}

TEST_CASE("with components given the system is the same as without") {
  const Mesh mesh = randomFaces(60, 300, 1);
  SampleProblem problem("random faces", mesh);
  const std::vector<double> weights = arcWeights(ArcWeightKind::Uniform, problem.graph, problem.geometry);
  const Components components = findComponents(mesh, problem.graph);
  REQUIRE(components.components.size() > 3);
  const PoissonSystem searched = buildPoissonSystem(problem.graph, weights, problem.values, {});
  const PoissonSystem told =
      buildPoissonSystem(problem.graph, weights, problem.values, {}, {.componentOf = components.componentOf});
  const auto unknownCount =
      std::count_if(problem.values.begin(), problem.values.end(), [](double value) { return !std::isfinite(value); });
  REQUIRE(searched.unknownCount() < unknownCount);  // Some component has no known face.
  CHECK(told.faces == searched.faces);
  CHECK(told.columns == searched.columns);
  CHECK(sameBits(told.entries, searched.entries));
  CHECK(sameBits(told.rightHandSide, searched.rightHandSide));
}

TEST_CASE("Jacobi is plain for the first order, and damped below 2 over the largest eigenvalue for the second") {
  forEachSetting([&](const Setting& setting) {
    const auto& [problem, kind, beta, weights] = setting;
    const PoissonSystem system = buildPoissonSystem(problem.graph, weights, problem.values, {}, {.secondOrder = beta});
    const Eigen::Map<const Eigen::VectorXd> diagonal(system.diagonal.data(), system.unknownCount());
    const Eigen::VectorXd roots = diagonal.cwiseSqrt().cwiseInverse();
    const Eigen::VectorXd eigenvalues = (roots.asDiagonal() * denseMatrix(system) * roots.asDiagonal())
                                            .eval()
                                            .selfadjointView<Eigen::Lower>()
                                            .eigenvalues();
    const double heldBack = heldBackByJacobi(system);
    if (beta == 0) CHECK(heldBack == 0);
    CHECK((1 - heldBack) * eigenvalues.maxCoeff() < 2);
    CHECK(heldBack < 0.7);
  });
}
