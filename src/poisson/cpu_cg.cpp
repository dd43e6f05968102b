#include "poisson/cpu_cg.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "poisson/poisson_solver.h"

namespace asdfvk {
namespace {

constexpr size_t kBlockRowCount = 4096;  // Small enough to give every core of a big machine some rows of a small mesh.
static_assert(kBlockRowCount % kRowsAtOnce == 0);
constexpr size_t kSumCount = 8;
constexpr uint32_t kIterationsPerCheckpoint = 8;

// Rounding lets the residual of the recurrence differ from the true residual, in float32 by about 1e-7 of the first
// residual.
constexpr double kMinFloatReduction = 1e-6, kMinDoubleReduction = 1e-13;

/// The matrix S in double, as an Eigen sparse matrix that uses the columns of the system.
class EigenSystem : public DiagonalScaling<double> {
 public:
  using Real = double;
  static double rounding() { return 2e-16; }

  explicit EigenSystem(const PoissonSystem& system)
      : DiagonalScaling(system.diagonal),
        size_(static_cast<Eigen::Index>(system.unknownCount())),
        couplings_(system.entries.size()),
        matrix_(size_, size_, static_cast<Eigen::Index>(system.columns.size()),
                reinterpret_cast<const int*>(system.rowOffsets.data()),
                reinterpret_cast<const int*>(system.columns.data()), couplings_.data()) {
    // Eigen's map has an int as the number of entries.
    ASDFVK_CHECK_OP(system.columns.size(), <=, static_cast<size_t>(std::numeric_limits<int>::max()));
    const UnsetVector<double> roots = inverseRoots(system);
    forEachInParallel(roots.size(), [&](size_t row) {
      for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i)
        couplings_[i] = -system.entries[i] * roots[row] * roots[system.columns[i]];
    });
  }

  void multiplyRows(const double* p, double* product, size_t begin, size_t end) const {
    const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    Eigen::Map<Vector> rows(product + begin, count);
    rows = Eigen::Map<const Vector>(p + begin, count);
    rows.noalias() -= matrix_.middleRows(first, count) * Eigen::Map<const Vector>(p, size_);
  }

 private:
  using Vector = Eigen::VectorXd;

  Eigen::Index size_;
  UnsetVector<double> couplings_;
  Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor, int>> matrix_;
};

template <typename System>
Corrector makeCorrector(const PoissonSystem& system, SolverProgress& progress, double minReduction) {
  return {minReduction,
          [&system, &progress, scaled = std::shared_ptr<System>()](const CorrectionRequest& request) mutable {
            progress.checkpoint(request.norm);
            if (!scaled) scaled = std::make_shared<System>(system);
            CpuCg<System> cg(*scaled, scaled->scaleResidual(request.residual, request.norm), request.reduction);
            typename CpuCg<System>::State state;
            while (state.status == kCgRunning && state.iterationCount < request.maxIterations) {
              state = cg.advance(std::min(kIterationsPerCheckpoint, request.maxIterations - state.iterationCount));
              progress.checkpoint(request.norm * std::sqrt(static_cast<double>(state.residualSquared)));
            }
            scaled->unscaleCorrection(cg.solution(), request.norm, request.correction);
            return state.iterationCount;
          }};
}

Corrector makeDoubleCorrector(const PoissonSystem& system, SolverProgress& progress) {
  return makeCorrector<EigenSystem>(system, progress, kMinDoubleReduction);
}

}  // namespace

template <typename System>
CpuCg<System>::CpuCg(const System& system, UnsetVector<Real> rightHandSide, double reduction)
    : system_(system),
      toleranceSquared_(static_cast<Real>(reduction * reduction)),
      solution_(rightHandSide.size()),
      residual_(std::move(rightHandSide)),
      direction_(residual_.size()),
      product_(residual_.size()),
      sums_((residual_.size() + kBlockRowCount - 1) / kBlockRowCount) {
  forEachBlock([&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      solution_[i] = 0;
      direction_[i] = residual_[i];
    }
  });
}

template <typename System>
template <typename Body>
void CpuCg<System>::forEachBlock(const Body& body) {
  loop_.forEachRange(sums_.size(), [&](size_t first, size_t last) {
    for (size_t block = first; block < last; ++block)
      body(block, block * kBlockRowCount, std::min((block + 1) * kBlockRowCount, direction_.size()));
  });
}

template <typename System>
typename CpuCg<System>::BlockSums CpuCg<System>::sumRows(size_t begin, size_t end) const {
  const Real* weights = system_.residualWeights().data();
  // Separate sums per lane, which compilers can vectorise without reordering additions.
  std::array<std::array<Real, kSumCount>, std::tuple_size_v<BlockSums>> lanes{};
  const auto add = [&](size_t i, size_t lane) {
    const Real p = direction_[i], product = product_[i], r = residual_[i];
    lanes[0][lane] += p * p;
    lanes[1][lane] += p * product;
    lanes[2][lane] += product * product;
    lanes[3][lane] += r * product;
    lanes[4][lane] += r * r;
    lanes[5][lane] += r * r * weights[i];
  };
  size_t i = begin;
  for (; i + kSumCount <= end; i += kSumCount)
    for (size_t lane = 0; lane < kSumCount; ++lane) add(i + lane, lane);
  for (; i < end; ++i) add(i, 0);
  BlockSums sums{};
  for (size_t k = 0; k < sums.size(); ++k)
    for (Real lane : lanes[k]) sums[k] += static_cast<double>(lane);
  return sums;
}

template <typename System>
typename CpuCg<System>::Rules::CgSums CpuCg<System>::multiply() {
  const auto addTo = [](BlockSums& sums, const BlockSums& more) {
    for (size_t k = 0; k < sums.size(); ++k) sums[k] += more[k];
  };
  forEachBlock([&](size_t block, size_t begin, size_t end) {
    BlockSums sums{};
    for (size_t chunk = begin; chunk < end; chunk += kRowsAtOnce) {
      const size_t chunkEnd = std::min(chunk + kRowsAtOnce, end);
      system_.multiplyRows(direction_.data(), product_.data(), chunk, chunkEnd);
      addTo(sums, sumRows(chunk, chunkEnd));
    }
    sums_[block] = sums;
  });
  BlockSums total{};
  for (const BlockSums& sums : sums_) addTo(total, sums);
  return std::apply([](auto... sum) { return typename Rules::CgSums{static_cast<Real>(sum)...}; }, total);
}

template <typename System>
void CpuCg<System>::step(Real alpha, Real beta) {
  forEachBlock([&](size_t, size_t begin, size_t end) {
    Real* __restrict x = solution_.data();
    Real* __restrict r = residual_.data();
    Real* __restrict p = direction_.data();
    const Real* __restrict product = product_.data();
    for (size_t i = begin; i < end; ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * product[i];
      p[i] = r[i] + beta * p[i];
    }
  });
}

template <typename System>
typename CpuCg<System>::State CpuCg<System>::advance(uint32_t iterationCount) {
  for (uint32_t i = 0; i < iterationCount && state_.status == kCgRunning; ++i) {
    const auto sums = multiply();
    const auto next = Rules::nextCgStep(sums, toleranceSquared_, System::rounding());
    state_.residualSquared = sums.residualSquared;
    state_.status = next.status;
    if (next.status != kCgRunning) break;
    step(next.alpha, next.beta);
    ++state_.iterationCount;
  }
  return state_;
}

template class CpuCg<ScaledSystem>;

SolverReport solveByCpuCg(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                          const RunControl& control) {
  SolverProgress progress(rightHandNorm(system), options, control);
  return solveByRefinement(
      system, options, solution,
      {makeCorrector<ScaledSystem>(system, progress, kMinFloatReduction), makeDoubleCorrector(system, progress)});
}

SolverReport solveByEigen(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                          const RunControl& control) {
  SolverProgress progress(rightHandNorm(system), options, control);
  return solveByRefinement(system, options, solution, {makeDoubleCorrector(system, progress)});
}

}  // namespace asdfvk
