#include <algorithm>
#include <cmath>
#include <optional>

#include "poisson/cpu_cg.h"
#include "poisson/eigen_corrector.h"
#include "poisson/poisson_solver.h"
#include "poisson/solver_progress.h"

namespace asdfvk {
namespace {

// The residual that float32 recurs on leaves the true one at about 1e-7 of the first.
constexpr double kStrongestReduction = 1e-6;
constexpr uint32_t kIterationsPerCheckpoint = 8;

class CpuCgSolver final : public PoissonSolver {
 public:
  SolverReport solve(const PoissonSystem& system, const SolverOptions& options, std::span<double> solution,
                     const RunControl& control) override {
    SolverProgress progress(system, options, control);
    std::optional<ScaledSystem> scaled;
    const auto correct = [&](const CorrectionRequest& request) {
      if (!scaled) scaled.emplace(system);
      progress.checkpoint(request.norm);
      CpuCg cg(*scaled, scaled->scaleResidual(request.residual, request.norm), request.reduction);
      CgState state{};
      while (state.status == kCgRunning && state.iterationCount < request.maxIterations) {
        state = cg.advance(std::min(kIterationsPerCheckpoint, request.maxIterations - state.iterationCount));
        progress.checkpoint(request.norm * std::sqrt(static_cast<double>(state.residualSquared)));
      }
      scaled->unscaleCorrection(cg.solution(), request.norm, request.correction);
      return state.iterationCount;
    };
    return solveByRefinement("cpu", system, options, solution,
                             {{kStrongestReduction, correct}, makeEigenCorrector(system, progress)});
  }
};

}  // namespace

std::unique_ptr<PoissonSolver> makeCpuCgSolver() { return std::make_unique<CpuCgSolver>(); }

}  // namespace asdfvk
