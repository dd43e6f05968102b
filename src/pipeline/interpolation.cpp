#include "pipeline/interpolation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "mesh/curvature.h"
#include "pipeline/scene_tracers.h"
#include "poisson/poisson_solver.h"
#include "poisson/poisson_system.h"

namespace asdfvk {
namespace {

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

/// Limits values of a component, which guidance, and rounding of the solvers, move beyond those of the seeds: below to
/// the smaller of the lowest seed value and the prediction of the face, if any, above to the highest seed value, since
/// the faces with the greatest predictions are seeds (extremeSeeds()). Returns the number of limited faces. predicted:
/// #F, or empty.
uint64_t keepWithinTraced(const FaceDomain& domain, const std::vector<ComponentValues>& traced,
                          std::span<const double> predicted, std::vector<double>& values) {
  return countInParallel(values.size(), [&](uint32_t face) {
    const ComponentValues& component = traced[domain.componentOf[face]];
    if (component.count == 0 || !std::isfinite(values[face])) return false;
    const double prediction = predicted.empty() ? kNoValue : predicted[face];
    const double low = std::isfinite(prediction) ? std::min(component.low, prediction) : component.low;
    const double value = std::clamp(values[face], low, component.high);
    return std::exchange(values[face], value) != value;
  });
}

}  // namespace

const Solver& Interpolation::chosenSolver() const {
  return isAutomatic() ? automaticSolver(computation_.backend) : findSolver(computation_.options.solver);
}

/// A CPU device needs more time than the CPU for the same predictions (docs/experiments.md). Fewer storage buffers
/// suffice than for the solvers.
bool Interpolation::predictsOnDevice() const {
  return computation_.keepsHits() && computation_.backend.device() != nullptr && !predictorFailed_ &&
         (isAutomatic() ? !computation_.backend.runsOnCpu() : chosenSolver().needsDevice);
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

void Interpolation::predict(const SeedHits& hits, const RunControl& control) {
  if (!computation_.keepsHits() || hits.seeds.empty()) return;
  if (DevicePredictor* const device = devicePredictor()) {
    try {
      return predictWith(device, hits, control);
    } catch (const Error& error) {
      continueOnCpu(error);
    }
  }
  if (!hits.hits.empty()) return predictWith(nullptr, hits, control);
  const std::vector<ConeHit> stored = predictor_->hitStore()->download();
  predictWith(nullptr, {hits.seeds, stored}, control);
}

void Interpolation::predictWith(DevicePredictor* device, const SeedHits& hits, const RunControl& control) {
  prediction_ = predictValues(computation_.scene, computation_.domain.graph, computation_.cone, hits, {},
                              std::exchange(prediction_, {}), device, control);
}

Interpolated Interpolation::solve(std::span<const double> constraints, const RunControl& control) {
  const FaceDomain& domain = computation_.domain;
  Interpolated result;
  result.solver.name = "none";
  const std::span<const double> predicted = prediction_.values;
  const bool needsNone = computation_.keepsMissing() && computation_.options.seeds.kind == SeedCount::Kind::All;
  const bool hasAll =
      needsNone || std::all_of(constraints.begin(), constraints.end(), [](double v) { return std::isfinite(v); });
  if (!hasAll) {
    const std::vector<ComponentValues> traced = componentValues(domain, constraints);
    result.solver = solveEquation(traced, constraints, result.values, control);
    result.clampedCount = keepWithinTraced(domain, traced, predicted, result.values);
  } else {
    result.values.assign(constraints.begin(), constraints.end());
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

bool Interpolation::guidedByPrediction() const {
  return computation_.options.interpolation.guidance == Guidance::Prediction && !prediction_.values.empty();
}

std::vector<double> Interpolation::divergence() {
  switch (computation_.options.interpolation.guidance) {
    case Guidance::Prediction:
      if (!guidedByPrediction()) return {};
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

PoissonSystem Interpolation::buildSystem(const std::vector<ComponentValues>& traced,
                                         std::span<const double> constraints) {
  const std::vector<double> guess = firstGuess(computation_.domain, traced, prediction_.values);
  return buildPoissonSystem(computation_.domain.graph, weights(), constraints, divergence(),
                            {.firstGuess = guess, .componentOf = computation_.domain.componentOf});
}

/// Null where the solver has none, where the equation has few of the rows of the graph, and for a tolerance that needs
/// residuals in double.
GraphSolver* Interpolation::graphSolver(PoissonSolver& solver, size_t unknownCount) {
  const DualGraph& graph = computation_.domain.graph;
  if (2 * unknownCount < graph.faceCount()) return nullptr;
  if (computation_.options.solverOptions.tolerance < kMinGraphTolerance) return nullptr;
  if (solver_ != &solver) {
    graphSolver_.reset();
    solver_ = &solver;
    try {
      graphSolver_ = solver.onGraph(graph, weights());
    } catch (const Error& error) {  // The unknown faces alone may fit the device.
      if (error.code() != ErrorCode::EquationLimit) throw;
    }
  }
  return graphSolver_.get();
}

SolverReport Interpolation::solveWith(const std::string& name, const std::vector<ComponentValues>& traced,
                                      std::span<const double> constraints, std::vector<double>& values,
                                      const RunControl& control) {
  const FaceDomain& domain = computation_.domain;
  const uint64_t unknownCount = countInParallel(constraints.size(), [&](uint32_t face) {
    return !std::isfinite(constraints[face]) && traced[domain.componentOf[face]].count > 0;
  });
  if (unknownCount == 0) {
    values.assign(constraints.begin(), constraints.end());
    return {.name = "none"};
  }
  std::unique_ptr<PoissonSolver>& solver = computation_.solvers[name];
  if (!solver) solver = makeSolver(name, computation_.backend.device());
  const SolverOptions& options = computation_.options.solverOptions;
  SolverReport report;
  if (GraphSolver* const onGraph = graphSolver(*solver, unknownCount)) {
    const bool isGuided = guidedByPrediction();
    const std::vector<double> divergence = isGuided ? std::vector<double>{} : this->divergence();
    const std::vector<double> guess = firstGuess(domain, traced, prediction_.values);
    values.assign(constraints.begin(), constraints.end());
    report =
        onGraph->solve({.constraints = constraints,
                        .firstGuess = guess,
                        .guide = isGuided ? std::span<const double>(prediction_.values) : std::span<const double>{},
                        .divergence = divergence,
                        .componentOf = domain.componentOf},
                       options, values, control);
  } else {
    // The solve needs the most memory of a run: the solution takes the place of the first guess, and the values come
    // after the system.
    PoissonSystem system = buildSystem(traced, constraints);
    report = solver->solve(system, options, system.firstGuess, control);
    const std::vector<uint32_t> faces = std::move(system.faces);
    const std::vector<double> solution = std::move(system.firstGuess);
    system = {};
    values.assign(constraints.begin(), constraints.end());
    for (size_t i = 0; i < solution.size(); ++i) values[faces[i]] = solution[i];
  }
  report.name = name;
  return report;
}

/// values: #F, those of the constraints and the solution; empty before.
SolverReport Interpolation::solveEquation(const std::vector<ComponentValues>& traced,
                                          std::span<const double> constraints, std::vector<double>& values,
                                          const RunControl& control) {
  try {
    const std::string name = isAutomatic() ? chosenSolver().name : computation_.options.solver;
    return solveWith(name, traced, constraints, values, control);
  } catch (const Error& error) {
    if (!isAutomatic() || error.kind() != ErrorKind::Device) throw;
    solver_ = nullptr;
    computation_.warnings.push_back(
        {WarningCode::SolvedOnCpu,
         fmt::format("the CPU solved the equation because the device failed: {}", error.what()),
         {}});
    return solveWith(defaultSolver(false).name, traced, constraints, values, control);
  }
}

}  // namespace asdfvk
