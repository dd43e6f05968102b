#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/compute_backend.h"
#include "pipeline/options.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/report.h"
#include "pipeline/seed_tracing.h"
#include "predict/reprojection.h"

namespace asdfvk {

/// Values for all faces from those of the seeds.
struct Interpolated {
  std::vector<double> values;  ///< #F; faces of components without any value keep none.
  SolverReport solver;         ///< Its name is "none" when there was nothing to solve.
};

/// The interpolation of one mesh, for any sets of seeds.
class Interpolation {
 public:
  /// What it refers to must outlive it. Where the choice of solver is open and the device fails or is too small, the
  /// CPU solves instead and `warnings` says why.
  Interpolation(const PreparedMesh& prepared, const TraceScene& scene, const Cone& cone, const Options& options,
                ComputeBackend& backend, std::vector<std::string>& warnings);

  /// Predicts all faces from what the rays of these seeds met, if anybody kept that. Seeds that an earlier call was
  /// given must be at the same places of traced.seeds. seconds: what it took is added to them.
  void predict(const TracedCones& traced, StageSeconds& seconds);
  /// The last one, see reprojectHits(); empty without Guidance::Hits.
  [[nodiscard]] const Prediction& prediction() const { return prediction_; }

  /// Guided by the last prediction. known: #F, NaN where no value is. seconds: what it took is added to them.
  [[nodiscard]] Interpolated run(std::span<const double> known, StageSeconds& seconds, const RunControl& control);

 private:
  [[nodiscard]] const std::vector<double>& weights();
  [[nodiscard]] std::vector<double> divergence();
  SolverReport solve(const PoissonSystem& system, std::vector<double>& values, const RunControl& control);

  const PreparedMesh& prepared_;
  const TraceScene& scene_;
  const Cone& cone_;
  const Options& options_;
  ComputeBackend& backend_;
  std::vector<std::string>& warnings_;
  std::vector<double>
      weights_;  ///< One per arc of the dual graph, once something is to be solved: tracing holds more than enough.
  Prediction prediction_;
};

}  // namespace asdfvk
