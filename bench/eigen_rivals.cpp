#include "eigen_rivals.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

namespace asdfvk::bench {
namespace {

using Vector = Eigen::VectorXd;

template <typename Preconditioner>
uint32_t solveIteratively(const EigenMatrix& matrix, const PoissonSystem& system, double tolerance,
                          std::span<double> solution) {
  Eigen::ConjugateGradient<EigenMatrix, Eigen::Lower | Eigen::Upper, Preconditioner> solver;
  solver.setTolerance(tolerance);
  solver.compute(matrix);
  const Eigen::Map<const Vector> b(system.rightHandSide.data(), matrix.rows());
  Eigen::Map<Vector>(solution.data(), matrix.rows()) =
      solver.solveWithGuess(b, Vector::Constant(matrix.rows(), system.knownMean));
  return static_cast<uint32_t>(solver.iterations());
}

uint32_t solveByFactors(const EigenMatrix& matrix, const PoissonSystem& system, double, std::span<double> solution) {
  const Eigen::SimplicialLDLT<EigenMatrix> factors(matrix);
  const Eigen::Map<const Vector> b(system.rightHandSide.data(), matrix.rows());
  Eigen::Map<Vector>(solution.data(), matrix.rows()) = factors.solve(b);
  return 0;
}

}  // namespace

EigenMatrix eigenMatrix(const PoissonSystem& system) {
  const auto size = static_cast<Eigen::Index>(system.unknownCount());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(system.columns.size() + system.faces.size());
  for (uint32_t row = 0; row < system.unknownCount(); ++row) {
    entries.emplace_back(row, row, system.diagonal[row]);
    for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i)
      entries.emplace_back(row, system.columns[i], system.entries[i]);
  }
  EigenMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<EigenRival> eigenRivals() {
  using IncompleteCholesky = Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;
  return {{"Eigen's CG, Jacobi", solveIteratively<Eigen::DiagonalPreconditioner<double>>},
          {"Eigen's CG, incomplete Cholesky", solveIteratively<IncompleteCholesky>},
          {"Eigen's SimplicialLDLT", solveByFactors}};
}

}  // namespace asdfvk::bench
