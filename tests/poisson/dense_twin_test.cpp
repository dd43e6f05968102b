#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dense_twin.h"
#include "poisson/poisson_system.h"
#include "sample_problems.h"
#include "support/bits.h"

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

}  // namespace

TEST_CASE("matrix and right-hand side are those of dense algebra, for all weights") {
  forEachSetting([&](const Setting& setting) {
    const auto& [problem, kind, weights] = setting;
    std::vector<double> divergence = randomField(problem.values.size());
    divergence[3] = kNoValue;
    const PoissonSystem system =
        buildPoissonSystem(problem.graph, weights, problem.values, divergence, searchComponents(problem.graph));
    const DenseTwin twin(problem.graph, weights, problem.values, divergence);
    REQUIRE(std::equal(system.faces.begin(), system.faces.end(), twin.faces.begin(), twin.faces.end()));
    REQUIRE(system.unknownCount() > 40);
    REQUIRE(system.unknownCount() < problem.values.size());
    const Eigen::MatrixXd matrix = denseMatrix(system);
    const auto scale = twin.matrix.diagonal().array();
    CHECK(((matrix - twin.matrix).array().colwise() / scale).abs().maxCoeff() < 1e-14);
    const Eigen::Map<const Eigen::VectorXd> b(system.rightHandSide.data(), matrix.rows());
    CHECK(((b - twin.rightHandSide).array() / scale).abs().maxCoeff() <
          1e-14 * (1 + (twin.rightHandSide.array() / scale).abs().maxCoeff()));
    // Conjugate gradients assume exact symmetry.
    CHECK(matrix == matrix.transpose());
    for (uint32_t row = 0; row < system.unknownCount(); ++row)
      CHECK(std::adjacent_find(system.columns.begin() + system.rowOffsets[row],
                               system.columns.begin() + system.rowOffsets[row + 1],
                               std::greater_equal<>()) == system.columns.begin() + system.rowOffsets[row + 1]);
    CHECK(std::all_of(system.entries.begin(), system.entries.end(), [](double e) { return e < 0; }));
  });
}

TEST_CASE("with constraints and divergence of a field, the field is the solution") {
  forEachSetting([&](const Setting& setting) {
    const auto& [problem, kind, weights] = setting;
    const std::vector<double> field = randomField(problem.values.size());
    std::vector<double> values = problem.values;
    for (size_t f = 0; f < values.size(); ++f)
      if (std::isfinite(values[f])) values[f] = field[f];
    const PoissonSystem system =
        buildPoissonSystem(problem.graph, weights, values, divergenceOf(problem.graph, weights, field),
                           searchComponents(problem.graph), field);
    CHECK(relativeResidual(system, system.firstGuess) < 1e-13);
    const Eigen::VectorXd solution = denseMatrix(system).ldlt().solve(
        Eigen::Map<const Eigen::VectorXd>(system.rightHandSide.data(), system.unknownCount()));
    for (uint32_t i = 0; i < system.unknownCount(); ++i)
      CHECK(solution[i] == doctest::Approx(field[system.faces[i]]).epsilon(1e-6).scale(1));
  });
}

TEST_CASE("weights, divergence and system have the same bits on any number of threads") {
  const SampleProblem problem("torus", torus(160, 80));
  const std::vector<double> field = randomField(problem.values.size());
  for (ArcWeights kind : kArcWeights) {
    std::vector<std::vector<double>> numbers[3];
    for (const size_t threadCount : {1, 2, 3}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
      const UnsetVector<double> weights = weightsOf(kind, problem.graph, problem.geometry);
      const std::vector<double> divergence = divergenceOf(problem.graph, weights, field);
      PoissonSystem system =
          buildPoissonSystem(problem.graph, weights, problem.values, divergence, searchComponents(problem.graph));
      numbers[threadCount - 1] = {{weights.begin(), weights.end()}, divergence};
      for (const auto& ofSystem : {system.entries, system.diagonal, system.rightHandSide})
        numbers[threadCount - 1].emplace_back(ofSystem.begin(), ofSystem.end());
    }
    for (size_t i = 0; i < numbers[0].size(); ++i) {
      CHECK(test::haveSameBits(numbers[0][i], numbers[1][i]));
      CHECK(test::haveSameBits(numbers[0][i], numbers[2][i]));
    }
  }
}

TEST_CASE("a first guess that is not finite is replaced by the mean of the constraints") {
  const HandGraph hand(std::vector<Vec3d>(4), {{0, 1}, {1, 2}, {2, 3}});
  const std::vector<double> weights(6, 1.0), values{2, kNoValue, kNoValue, 4};
  const std::vector<uint32_t> componentOf(4, 0);
  CHECK(buildPoissonSystem(hand.graph, weights, values, {}, componentOf).firstGuess.empty());
  const PoissonSystem system =
      buildPoissonSystem(hand.graph, weights, values, {}, componentOf, std::vector<double>{9, kNoValue, 7, 9});
  CHECK(system.firstGuess == std::vector<double>{3, 7});
}
