#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "pipeline/computation.h"
#include "predict/prediction.h"

namespace asdfvk {

/// Values of all faces, interpolated from those of the seeds.
struct Interpolated {
  std::vector<double> values;  ///< #F; NaN outside of the domain and in components without any value.
  SolverReport solver;         ///< Its name is "none" where there was nothing to solve.
  uint64_t clampedCount = 0;   ///< Faces whose solution was limited to the values of the seeds.
};

/// Traced values of one component. Components are separate because parts of one mesh may differ in size by any factor.
struct ComponentValues {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  double mean = 0;
  uint64_t count = 0;
};

/// Interpolation on one mesh, for any sets of seeds.
class Interpolation {
 public:
  /// The computation must outlive it. With a solver of the device, the device predicts, too. Where the solver is "auto"
  /// and the device fails or is too small, the CPU predicts or solves the equation and a warning contains the reason.
  explicit Interpolation(const Computation& computation) : computation_(computation) {}

  /// Where the device that predicts keeps the hits of seeds; null where the host must keep them.
  [[nodiscard]] HitStore* hitStore();
  /// Predicts all faces from the hits of these seeds, or from those in hitStore(); where hits are not kept it does
  /// nothing. Seeds of an earlier call must be at the same indices of hits.seeds. Throws Error{Cancelled}.
  void predict(const SeedHits& hits, const RunControl& control);
  /// The last one; empty without Guidance::Prediction.
  [[nodiscard]] const Prediction& prediction() const { return prediction_; }

  /// Guided by the last prediction. constraints: #F, NaN where a value is unknown.
  [[nodiscard]] Interpolated solve(std::span<const double> constraints, const RunControl& control);

 private:
  [[nodiscard]] bool isAutomatic() const { return computation_.options.solver == kAutomaticSolver; }
  [[nodiscard]] const Solver& chosenSolver() const;
  [[nodiscard]] bool predictsOnDevice() const;
  DevicePredictor* devicePredictor();
  void continueOnCpu(const Error& failure);
  void predictWith(DevicePredictor* device, const SeedHits& hits, const RunControl& control);
  [[nodiscard]] const std::vector<double>& weights();
  [[nodiscard]] bool guidedByPrediction() const;
  [[nodiscard]] std::vector<double> divergence();
  [[nodiscard]] PoissonSystem buildSystem(const std::vector<ComponentValues>& traced,
                                          std::span<const double> constraints);
  [[nodiscard]] GraphSolver* graphSolver(PoissonSolver& solver, size_t unknownCount);
  SolverReport solveEquation(const std::vector<ComponentValues>& traced, std::span<const double> constraints,
                             std::vector<double>& values, const RunControl& control);
  SolverReport solveWith(const std::string& solver, const std::vector<ComponentValues>& traced,
                         std::span<const double> constraints, std::vector<double>& values, const RunControl& control);

  const Computation& computation_;
  std::vector<double> weights_;  ///< One per arc of the dual graph; computed lazily, so that tracing does not hold it.
  std::unique_ptr<GraphSolver> graphSolver_;  ///< Created at first use; of solver_.
  const PoissonSolver* solver_ = nullptr;
  Prediction prediction_;
  std::unique_ptr<DevicePredictor> predictor_;  ///< Created at first use; kept after a failure, for its hits.
  bool predictorFailed_ = false;
};

}  // namespace asdfvk
