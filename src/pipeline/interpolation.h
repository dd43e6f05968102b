#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/compute_backend.h"
#include "pipeline/options.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/report.h"
#include "pipeline/seed_tracing.h"
#include "reprojection/reprojection.h"

namespace asdfvk {

/// What an interpolation starts from: all traced seeds, or some of them.
struct KnownSeeds {
  std::span<const double> values;   ///< #F, NaN where none is known.
  std::span<const uint32_t> faces;  ///< #S, as TracedSeeds::faces, but kNoFace for a seed that is left out.
  std::span<const ConeHit> hits;    ///< #S x rays, those of seeds left out among them; empty if nobody wants them.
};

/// Values for all faces from those of the seeds.
struct Interpolated {
  std::vector<double> values;  ///< #F; faces of components without any value keep none.
  SolverReport solver;         ///< Its name is "none" when there was nothing to solve.
};

/// The interpolation of one mesh, for any sets of seeds.
class Interpolation {
 public:
  /// What it refers to must outlive it. Where the choice of solver is open and the device fails or is too small, Eigen
  /// solves instead and `warnings` says why.
  Interpolation(const PreparedMesh& prepared, const TraceScene& scene, const Cone& cone, const Options& options,
                ComputeBackend& backend, std::vector<std::string>& warnings);

  /// seconds: what predicting and solving took is added to them.
  /// Seeds that an earlier run was given must be at the same places of known.faces.
  [[nodiscard]] Interpolated run(const KnownSeeds& known, StageSeconds& seconds, const RunControl& control);

  /// Of the last run: #F, see reprojectHits(); empty without Guidance::Hits.
  [[nodiscard]] std::span<const double> prediction() const { return prediction_.values; }

  /// The same without any guidance, to a tolerance that is enough for comparing. known: as KnownSeeds::values.
  /// firstGuess: #F.
  [[nodiscard]] std::vector<double> runHarmonic(std::span<const double> known, std::span<const double> firstGuess,
                                                const RunControl& control);

 private:
  void predict(const KnownSeeds& known);
  /// What run() does once there is a prediction.
  [[nodiscard]] Interpolated solveFor(std::span<const double> known, const RunControl& control);
  [[nodiscard]] const std::vector<double>& weights();
  [[nodiscard]] std::vector<double> divergence();
  SolverReport solve(const PoissonSystem& system, std::vector<double>& values, const SolverOptions& solverOptions,
                     const RunControl& control);

  const PreparedMesh& prepared_;
  const TraceScene& scene_;
  const Cone& cone_;
  const Options& options_;
  ComputeBackend& backend_;
  std::vector<std::string>& warnings_;
  std::vector<double> weights_;  ///< One per arc of the dual graph, once something is to be solved.
  Prediction prediction_;        ///< Of the last run.
};

}  // namespace asdfvk
