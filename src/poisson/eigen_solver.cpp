#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>

#include "core/check.h"
#include "poisson/eigen_corrector.h"
#include "poisson/poisson_solver.h"
#include "poisson/refinement.h"
#include "poisson/solver_progress.h"

namespace asdfvk {
namespace {

using Vector = Eigen::VectorXd;
using OffDiagonals = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor, int>>;

constexpr double kStrongestEigenReduction = 1e-13;
constexpr uint32_t kEigenIterationsPerCheckpoint = 8;

// Rows are shared out among the threads, each summed by one: the same bits whatever their number.
void multiply(const PoissonSystem& system, const OffDiagonals& entries, const Vector& p, Vector& product) {
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, p.size(), 16384),
                    [&](const tbb::blocked_range<Eigen::Index>& range) {
                      for (Eigen::Index row = range.begin(); row < range.end(); ++row) {
                        double sum = system.diagonal[static_cast<size_t>(row)] * p[row];
                        for (OffDiagonals::InnerIterator entry(entries, row); entry; ++entry)
                          sum += entry.value() * p[entry.col()];
                        product[row] = sum;
                      }
                    });
}

// The loop is ours and not Eigen::ConjugateGradient's because that one can only be polled by restarting it, which
// throws its search directions away.
uint32_t conjugateGradient(const PoissonSystem& system, const CorrectionRequest& request, SolverProgress& progress) {
  const Eigen::Index size = static_cast<Eigen::Index>(system.faces.size());
  // Eigen's maps count in int.
  const OffDiagonals entries(size, size, static_cast<Eigen::Index>(system.columns.size()),
                             reinterpret_cast<const int*>(system.rowOffsets.data()),
                             reinterpret_cast<const int*>(system.columns.data()), system.entries.data());
  const Eigen::Map<const Vector> diagonal(system.diagonal.data(), size);
  Eigen::Map<Vector> x(request.correction.data(), size);
  x.setZero();
  Vector r = Eigen::Map<const Vector>(request.residual.data(), size);
  // Scaled to 1, so that squares neither overflow nor underflow, whatever the unit of the values.
  const double scale = r.stableNorm();
  r /= scale;
  Vector z = r.cwiseQuotient(diagonal), p = z, product(size);
  double rz = r.dot(z);
  uint32_t iteration = 0;
  const double firstNorm = z.stableNorm();
  double norm = 1;
  while (norm > request.reduction && iteration < request.maxIterations) {
    if (iteration % kEigenIterationsPerCheckpoint == 0) progress.checkpoint(norm * firstNorm * scale);
    multiply(system, entries, p, product);
    const double alpha = rz / p.dot(product);
    x += alpha * p;
    r -= alpha * product;
    z = r.cwiseQuotient(diagonal);
    norm = z.stableNorm() / firstNorm;
    ++iteration;
    const double oldRz = rz;
    rz = r.dot(z);
    if (!(rz > 0)) break;
    p = z + (rz / oldRz) * p;
  }
  x *= scale;
  return iteration;
}

class EigenSolver final : public PoissonSolver {
 public:
  SolverReport solve(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                     const RunControl& control) override {
    SolverProgress progress(system, options, control);
    return solveByRefinement("eigen", system, options, solution, {makeEigenCorrector(system, progress)});
  }
};

}  // namespace

Corrector makeEigenCorrector(const PoissonSystem& system, SolverProgress& progress) {
  return {kStrongestEigenReduction, [&system, &progress](const CorrectionRequest& request) {
            ASDFVK_CHECK_OP(system.columns.size(), <=, static_cast<size_t>(std::numeric_limits<int>::max()));
            return conjugateGradient(system, request, progress);
          }};
}

std::unique_ptr<PoissonSolver> makeEigenSolver() { return std::make_unique<EigenSolver>(); }

}  // namespace asdfvk
