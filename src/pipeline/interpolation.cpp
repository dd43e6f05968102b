#include "pipeline/interpolation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "mesh/curvature.h"
#include "poisson/divergence.h"
#include "poisson/poisson_system.h"

namespace asdfvk {
namespace {

/// The values traced in one component. Each has its own, since parts of one mesh may differ in size by any factor.
struct ComponentValues {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  double mean = 0;
  uint64_t count = 0;
};

std::vector<ComponentValues> componentValues(const Components& components, std::span<const double> known) {
  std::vector<ComponentValues> values(components.components.size());
  for (size_t face = 0; face < known.size(); ++face) {  // Not by seed: the order would reach the last bit.
    const double value = known[face];
    if (!std::isfinite(value)) continue;
    ComponentValues& component = values[components.componentOf[face]];
    component.low = std::min(component.low, value);
    component.high = std::max(component.high, value);
    ++component.count;
    component.mean += (value - component.mean) / static_cast<double>(component.count);
  }
  return values;
}

/// Where the solvers start: the prediction, or the mean of the component's seeds where there is none.
std::vector<double> firstGuess(const Components& components, const std::vector<ComponentValues>& traced,
                               std::span<const double> prediction) {
  std::vector<double> guess(components.componentOf.size(), kNoValue);
  forEachInParallel(guess.size(), [&](size_t face) {
    const ComponentValues& component = traced[components.componentOf[face]];
    if (component.count > 0) guess[face] = component.mean;
    if (!prediction.empty() && std::isfinite(prediction[face])) guess[face] = prediction[face];
  });
  return guess;
}

/// Guidance carries values beyond those of the seeds: downwards as far as the prediction, which is a mean of lengths,
/// goes itself; upwards not at all, since the faces with the greatest predictions are seeds (see chooseScouts()).
void keepWithinTraced(const Components& components, const std::vector<ComponentValues>& traced,
                      std::span<const double> predicted, std::vector<double>& values) {
  forEachInParallel(values.size(), [&](size_t face) {
    const ComponentValues& component = traced[components.componentOf[face]];
    if (component.count == 0 || !std::isfinite(values[face])) return;
    const double prediction = predicted[face];
    const double least = std::isfinite(prediction) ? std::min(component.low, prediction) : component.low;
    values[face] = std::clamp(values[face], least, std::max(least, component.high));
  });
}

}  // namespace

Interpolation::Interpolation(const PreparedMesh& prepared, const TraceScene& scene, const Cone& cone,
                             const Options& options, ComputeBackend& backend, std::vector<std::string>& warnings)
    : prepared_(prepared), scene_(scene), cone_(cone), options_(options), backend_(backend), warnings_(warnings) {}

void Interpolation::predict(const TracedCones& traced, StageSeconds& seconds) {
  if (traced.hits.empty()) return;
  const Stopwatch watch;
  prediction_ = reprojectHits(scene_, prepared_.graph, cone_, traced, options_.interpolation.reprojection,
                              std::move(prediction_));
  seconds.predict += watch.seconds();
}

Interpolated Interpolation::run(std::span<const double> known, StageSeconds& seconds, const RunControl& control) {
  const Stopwatch watch;
  Interpolated result;
  result.values.assign(known.begin(), known.end());
  result.solver.name = "none";
  const std::span<const double> predicted = prediction_.values;
  const bool hasAll = std::all_of(known.begin(), known.end(), [](double v) { return std::isfinite(v); });
  if (!hasAll) {
    const std::vector<ComponentValues> traced = componentValues(prepared_.components, known);
    const auto buildSystem = [&] {  // The first guess goes with it.
      const std::vector<double> guess = firstGuess(prepared_.components, traced, predicted);
      return buildPoissonSystem(prepared_.graph, weights(), known, divergence(),
                                {.firstGuess = guess, .componentOf = prepared_.components.componentOf});
    };
    const PoissonSystem system = buildSystem();
    result.solver = solve(system, result.values, control);
    if (!predicted.empty()) keepWithinTraced(prepared_.components, traced, predicted, result.values);
  }
  if (const double pooling = options_.interpolation.pooling; pooling > 0)
    for (size_t face = 0; face < predicted.size(); ++face)
      if (std::isfinite(predicted[face]) && std::isfinite(result.values[face]))
        result.values[face] += pooling * (predicted[face] - result.values[face]);
  seconds.solve += watch.seconds();
  return result;
}

const std::vector<double>& Interpolation::weights() {
  if (weights_.empty()) weights_ = arcWeights(options_.interpolation.weights, prepared_.graph, prepared_.geometry);
  return weights_;
}

std::vector<double> Interpolation::divergence() {
  switch (options_.interpolation.guidance) {
    case Guidance::Hits:
      if (prediction_.values.empty()) return {};
      return divergenceOf(prepared_.graph, weights(), prediction_.values);
    case Guidance::Curvature: {
      std::vector<double> divergence = faceCurvature(scene_.mesh);
      for (double& entry : divergence) entry = -entry;
      return divergence;
    }
    case Guidance::None:
      break;
  }
  return {};
}

SolverReport Interpolation::solve(const PoissonSystem& system, std::vector<double>& values, const RunControl& control) {
  if (system.unknownCount() == 0) return {.name = "none"};
  std::vector<double> solution(system.unknownCount());
  const auto solveWith = [&](SolverChoice choice) {
    return backend_.solver(choice).solve(system, options_.solverOptions, solution, control);
  };
  SolverReport report;
  try {
    report = solveWith(options_.solver);
  } catch (const Error& error) {
    if (options_.solver != SolverChoice::Auto || error.kind() != ErrorKind::Device) throw;
    warnings_.push_back(fmt::format("the CPU solved the equation, because on the device: {}", error.what()));
    report = solveWith(SolverChoice::Cpu);
  }
  for (size_t i = 0; i < solution.size(); ++i) values[system.faces[i]] = solution[i];
  return report;
}

}  // namespace asdfvk
