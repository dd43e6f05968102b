#include "pipeline/interpolation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "estimate/local_interpolation.h"
#include "mesh/curvature.h"
#include "poisson/poisson_system.h"

namespace asdfvk {
namespace {

std::vector<ComponentValues> componentValues(const FaceDomain& domain, std::span<const double> constraints) {
  const std::vector<uint32_t> known =
      indicesInParallel(domain.size(), [&](uint32_t node) { return std::isfinite(constraints[node]); });
  std::vector<ComponentValues> values(domain.componentCount);
  // In the order of the nodes, so that the order of the seeds does not change the last bit.
  for (const uint32_t node : known) {
    const double value = constraints[node];
    ComponentValues& component = values[domain.componentOf[node]];
    component.low = std::min(component.low, value);
    component.high = std::max(component.high, value);
    ++component.count;
    component.mean += (value - component.mean) / static_cast<double>(component.count);
  }
  return values;
}

/// Start of the solvers, #N: the prediction or, where there is none, the mean of the seeds of the component.
std::vector<double> firstGuess(const FaceDomain& domain, const std::vector<ComponentValues>& traced,
                               std::span<const double> prediction) {
  std::vector<double> guess(domain.size(), kNoValue);
  forEachInParallel(domain.size(), [&](uint32_t node) {
    const ComponentValues& component = traced[domain.componentOf[node]];
    if (component.count > 0) guess[node] = component.mean;
    if (!prediction.empty() && std::isfinite(prediction[node])) guess[node] = prediction[node];
  });
  return guess;
}

/// Limits a value of a component, because guidance and rounding in the solvers can move it beyond the values of the
/// seeds. Lower limit: the lowest seed value or, if smaller, the prediction of the face. Upper limit: the highest seed
/// value, because the faces with the greatest predictions are seeds (extremeSeeds()).
double limited(const ComponentValues& component, double prediction, double value) {
  if (component.count == 0 || !std::isfinite(value)) return value;
  const double low = std::isfinite(prediction) ? std::min(component.low, prediction) : component.low;
  return std::clamp(value, low, component.high);
}

/// Returns the number of limited nodes. predicted: #N, or empty.
uint64_t keepWithinTraced(const FaceDomain& domain, const std::vector<ComponentValues>& traced,
                          std::span<const double> predicted, std::vector<double>& values) {
  return countInParallel(domain.size(), [&](uint32_t node) {
    if (!std::isfinite(values[node])) return false;
    const double prediction = predicted.empty() ? kNoValue : predicted[node];
    const double value = limited(traced[domain.componentOf[node]], prediction, values[node]);
    return std::exchange(values[node], value) != value;
  });
}

}  // namespace

Interpolated Interpolation::solve(std::vector<double> constraints, std::span<const double> predicted,
                                  const RunControl& control) {
  Interpolated result;
  result.solver.name = "none";
  // In CGAL's definition only traced faces have values.
  const bool needsNone = options_.cone.definition == Definition::Cgal && options_.seeds.kind == SeedCount::Kind::All;
  if (needsNone || std::all_of(constraints.begin(), constraints.end(), [](double v) { return std::isfinite(v); })) {
    result.values = std::move(constraints);
    return result;
  }
  const std::vector<ComponentValues> traced = componentValues(domain_, constraints);
  const uint64_t unknownCount = countInParallel(domain_.size(), [&](uint32_t node) {
    return !std::isfinite(constraints[node]) && traced[domain_.componentOf[node]].count > 0;
  });
  if (unknownCount > 0)
    result.solver = solveEquation(constraints, predicted, traced, result.values, control);
  else
    result.values = std::move(constraints);
  result.clampedCount = keepWithinTraced(domain_, traced, predicted, result.values);
  return result;
}

double Interpolation::pooled(double value, double prediction) const {
  return std::isfinite(prediction) && std::isfinite(value)
             ? value + options_.interpolation.pooling * (prediction - value)
             : value;
}

void Interpolation::pool(std::span<const double> predicted, std::vector<double>& values) const {
  if (options_.interpolation.pooling > 0)
    forEachInParallel(predicted.size(), [&](uint32_t node) { values[node] = pooled(values[node], predicted[node]); });
}

std::vector<double> Interpolation::valuesAt(std::span<const uint32_t> nodes, std::span<const double> constraints,
                                            std::span<const double> predicted, std::span<const double> solved) {
  const std::vector<ComponentValues> traced = componentValues(domain_, constraints);
  const bool isGuided = options_.interpolation.guidance == Guidance::Prediction;
  const std::vector<double> divergence = this->divergence();
  std::vector<double> values = interpolateLocally(
      {domain_.graph, weights(), constraints, isGuided ? predicted : std::span<const double>(), divergence, solved},
      nodes);
  for (size_t i = 0; i < nodes.size(); ++i) {
    const double prediction = predicted.empty() ? kNoValue : predicted[nodes[i]];
    values[i] = pooled(limited(traced[domain_.componentOf[nodes[i]]], prediction, values[i]), prediction);
  }
  return values;
}

std::span<const double> Interpolation::weights() {
  if (weights_.empty())
    weights_ = options_.interpolation.weights == ArcWeights::Feature ? featureWeights(arcAngles_.take())
                                                                     : distanceWeights(domain_.graph, domain_.geometry);
  return weights_;
}

/// #N, or empty.
std::vector<double> Interpolation::divergence() const {
  if (options_.interpolation.guidance != Guidance::Curvature) return {};
  std::vector<double> divergence = atNodes(domain_, faceCurvature(mesh_));
  for (double& entry : divergence) entry = -entry;
  return divergence;
}

/// values: receives the constraints and the solution, #N; empty before the call.
SolverReport Interpolation::solveEquation(std::span<const double> constraints, std::span<const double> predicted,
                                          const std::vector<ComponentValues>& traced, std::vector<double>& values,
                                          const RunControl& control) {
  GraphProblem problem{.constraints = constraints,
                       .firstGuess = firstGuess(domain_, traced, predicted),
                       .guide = {},
                       .divergence = divergence(),
                       .componentOf = domain_.componentOf};
  if (options_.interpolation.guidance == Guidance::Prediction) problem.guide = predicted;
  return solver_.solve(domain_.graph, weights(), std::move(problem), values, control);
}

}  // namespace asdfvk
