#include "pipeline/interpolation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "mesh/curvature.h"
#include "pipeline/scene_tracers.h"
#include "poisson/poisson_solver.h"
#include "poisson/poisson_system.h"

namespace asdfvk {
namespace {

/// Traced values of one component. Components are separate because parts of one mesh may differ in size by any factor.
struct ComponentValues {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  double mean = 0;
  uint64_t count = 0;
};

std::vector<ComponentValues> componentValues(const FaceDomain& domain, std::span<const double> constraints) {
  std::vector<ComponentValues> values(domain.componentCount);
  for (size_t face = 0; face < constraints.size();
       ++face) {  // In face order, so that the order of the seeds does not change the last bit.
    const double value = constraints[face];
    if (!std::isfinite(value)) continue;
    ComponentValues& component = values[domain.componentOf[face]];
    component.low = std::min(component.low, value);
    component.high = std::max(component.high, value);
    ++component.count;
    component.mean += (value - component.mean) / static_cast<double>(component.count);
  }
  return values;
}

/// Start of the solvers: the prediction, or the mean of the seeds of the component where there is none.
std::vector<double> firstGuess(const FaceDomain& domain, const std::vector<ComponentValues>& traced,
                               std::span<const double> prediction) {
  std::vector<double> guess(domain.componentOf.size(), kNoValue);
  forEachInParallel(guess.size(), [&](size_t face) {
    const ComponentValues& component = traced[domain.componentOf[face]];
    if (component.count > 0) guess[face] = component.mean;
    if (!prediction.empty() && std::isfinite(prediction[face])) guess[face] = prediction[face];
  });
  return guess;
}

/// Limits values of a component, which guidance moves beyond those of the seeds: below to the smaller of the lowest
/// seed value and the prediction of the face, above to the highest seed value, since the faces with the greatest
/// predictions are seeds (extremeSeeds()).
void keepWithinTraced(const FaceDomain& domain, const std::vector<ComponentValues>& traced,
                      std::span<const double> predicted, std::vector<double>& values) {
  forEachInParallel(values.size(), [&](size_t face) {
    const ComponentValues& component = traced[domain.componentOf[face]];
    if (component.count == 0 || !std::isfinite(values[face])) return;
    const double prediction = predicted[face];
    const double low = std::isfinite(prediction) ? std::min(component.low, prediction) : component.low;
    values[face] = std::clamp(values[face], low, std::max(low, component.high));
  });
}

}  // namespace

/// A CPU device needs more time than the CPU for the same iterations and predictions (docs/speed.md).
const Solver& Interpolation::chosenSolver() const {
  return isAutomatic() ? defaultSolver(!computation_.backend.runsOnCpu()) : findSolver(computation_.options.solver);
}

bool Interpolation::predictsOnDevice() const {
  return computation_.keepsHits() && computation_.backend.device() != nullptr && !predictorFailed_ &&
         chosenSolver().needsDevice;
}

/// Null where the CPU predicts.
DevicePredictor* Interpolation::devicePredictor() {
  if (!predictsOnDevice()) return nullptr;
  try {
    if (!predictor_) {
      const auto scope = computation_.clock.time(setUpStage(computation_.backend));
      predictor_ = computation_.backend.makePredictor(computation_.scene, computation_.cone);
    }
    return predictor_.get();
  } catch (const Error& error) {
    continueOnCpu(error);
    return nullptr;
  }
}

/// Called in the handler of the failure.
void Interpolation::continueOnCpu(const Error& failure) {
  // A limit is no failure of the device, and a named solver does not request where values are predicted.
  if (failure.kind() != ErrorKind::Device || (!isAutomatic() && failure.code() != ErrorCode::DeviceLimit)) throw;
  predictorFailed_ = true;
  computation_.warnings.push_back(
      {WarningCode::PredictedOnCpu,
       fmt::format("the CPU predicted values because the device could not: {}", failure.what()),
       {}});
}

HitStore* Interpolation::hitStore() {
  DevicePredictor* const device = devicePredictor();
  return device != nullptr ? device->hitStore() : nullptr;
}

void Interpolation::predict(const SeedHits& hits) {
  if (!computation_.keepsHits() || hits.seeds.empty()) return;
  if (DevicePredictor* const device = devicePredictor()) {
    try {
      return predictWith(device, hits);
    } catch (const Error& error) {
      continueOnCpu(error);
    }
  }
  if (!hits.hits.empty()) return predictWith(nullptr, hits);
  const std::vector<ConeHit> stored = predictor_->hitStore()->download();
  predictWith(nullptr, {hits.seeds, stored});
}

void Interpolation::predictWith(DevicePredictor* device, const SeedHits& hits) {
  prediction_ = predictValues(computation_.scene, computation_.domain.graph, computation_.cone, hits, {},
                              std::exchange(prediction_, {}), device);
}

Interpolated Interpolation::solve(std::span<const double> constraints, const RunControl& control) {
  const FaceDomain& domain = computation_.domain;
  Interpolated result;
  result.values.assign(constraints.begin(), constraints.end());
  result.solver.name = "none";
  const std::span<const double> predicted = prediction_.values;
  const bool needsNone = computation_.keepsMissing() && computation_.options.seeds.kind == SeedCount::Kind::All;
  const bool hasAll =
      needsNone || std::all_of(constraints.begin(), constraints.end(), [](double v) { return std::isfinite(v); });
  if (!hasAll) {
    const std::vector<ComponentValues> traced = componentValues(domain, constraints);
    const auto buildSystem = [&] {  // Frees the guess before the solution.
      const std::vector<double> guess = firstGuess(domain, traced, predicted);
      return buildPoissonSystem(computation_.domain.graph, weights(), constraints, divergence(),
                                {.firstGuess = guess, .componentOf = domain.componentOf});
    };
    const PoissonSystem system = buildSystem();
    result.solver = solveSystem(system, result.values, control);
    if (!predicted.empty()) keepWithinTraced(domain, traced, predicted, result.values);
  }
  if (const double pooling = computation_.options.interpolation.pooling; pooling > 0)
    for (size_t face = 0; face < predicted.size(); ++face)
      if (std::isfinite(predicted[face]) && std::isfinite(result.values[face]))
        result.values[face] += pooling * (predicted[face] - result.values[face]);
  return result;
}

const std::vector<double>& Interpolation::weights() {
  if (weights_.empty())
    weights_ = arcWeights(computation_.options.interpolation.weights, computation_.domain.graph,
                          computation_.prepared.geometry);
  return weights_;
}

std::vector<double> Interpolation::divergence() {
  switch (computation_.options.interpolation.guidance) {
    case Guidance::Prediction:
      if (prediction_.values.empty()) return {};
      return divergenceOf(computation_.domain.graph, weights(), prediction_.values);
    case Guidance::Curvature: {
      std::vector<double> divergence = faceCurvature(computation_.scene.mesh);
      for (double& entry : divergence) entry = -entry;
      return divergence;
    }
    case Guidance::None:
      break;
  }
  return {};
}

SolverReport Interpolation::solveWith(const std::string& name, const PoissonSystem& system, std::span<double> solution,
                                      const RunControl& control) {
  std::unique_ptr<PoissonSolver>& solver = computation_.solvers[name];
  if (!solver) solver = makeSolver(name, computation_.backend.device());
  SolverReport report = solver->solve(system, computation_.options.solverOptions, solution, control);
  report.name = name;
  return report;
}

SolverReport Interpolation::solveSystem(const PoissonSystem& system, std::vector<double>& values,
                                        const RunControl& control) {
  if (system.unknownCount() == 0) return {.name = "none"};
  const std::string name = isAutomatic() ? chosenSolver().name : computation_.options.solver;
  std::vector<double> solution(system.unknownCount());
  SolverReport report;
  try {
    report = solveWith(name, system, solution, control);
  } catch (const Error& error) {
    if (!isAutomatic() || error.kind() != ErrorKind::Device) throw;
    computation_.warnings.push_back(
        {WarningCode::SolvedOnCpu,
         fmt::format("the CPU solved the equation because the device failed: {}", error.what()),
         {}});
    report = solveWith(defaultSolver(false).name, system, solution, control);
  }
  for (size_t i = 0; i < solution.size(); ++i) values[system.faces[i]] = solution[i];
  return report;
}

}  // namespace asdfvk
