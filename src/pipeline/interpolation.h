#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/compute_backend.h"
#include "pipeline/options.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/report.h"
#include "pipeline/seed_tracing.h"

namespace asdfvk {

/// Values for all faces from those of the seeds.
struct Interpolated {
  std::vector<double> values;      ///< #F; faces of components without any value keep none.
  std::vector<double> prediction;  ///< #F, see reprojectHits(); empty without Guidance::Hits.
  SolverReport solver;             ///< Its name is "none" when there was nothing to solve.
};

/// The interpolation of one mesh, for any sets of seeds.
class Interpolation {
 public:
  /// What it refers to must outlive it. Where the choice of solver is open and the device fails or is too small, Eigen
  /// solves instead and `warnings` says why.
  Interpolation(const PreparedMesh& prepared, const TraceScene& scene, const Cone& cone, const Options& options,
                ComputeBackend& backend, std::vector<std::string>& warnings);

  /// What the rays of the seeds let expect of all faces, see reprojectHits(): #F, empty without Guidance::Hits.
  /// seconds: what it took is added to them.
  [[nodiscard]] std::vector<double> predict(const TracedSeeds& traced, StageSeconds& seconds) const;

  /// prediction: of the same seeds. seconds: what it took is added to them.
  [[nodiscard]] Interpolated run(const TracedSeeds& traced, std::vector<double> prediction, StageSeconds& seconds,
                                 const RunControl& control);

  /// The same without any guidance, to a tolerance that is enough for comparing. firstGuess: #F.
  [[nodiscard]] std::vector<double> runHarmonic(const TracedSeeds& traced, std::span<const double> firstGuess,
                                                const RunControl& control);

 private:
  const std::vector<double>& arcWeightsOnce();
  [[nodiscard]] std::vector<double> divergence(std::span<const double> prediction);
  SolverReport solve(const PoissonSystem& system, std::vector<double>& values, const SolverOptions& solverOptions,
                     const RunControl& control);

  const PreparedMesh& prepared_;
  const TraceScene& scene_;
  const Cone& cone_;
  const Options& options_;
  ComputeBackend& backend_;
  std::vector<std::string>& warnings_;
  std::vector<double> weights_;  ///< One per arc of the dual graph; see arcWeightsOnce().
};

}  // namespace asdfvk
