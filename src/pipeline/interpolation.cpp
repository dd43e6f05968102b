#include "pipeline/interpolation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "estimate/local_interpolation.h"
#include "mesh/curvature.h"
#include "pipeline/aggregated_mesh.h"
#include "poisson/poisson_system.h"

namespace asdfvk {
namespace {

/// The faces that are nodes of the equation: the centres of the aggregates or, without aggregates, all faces.
/// Ascending.
class EquationFaces {
 public:
  explicit EquationFaces(const FaceDomain& domain)
      : centres_(domain.aggregated ? std::span(domain.aggregated->aggregates().centres) : std::span<const uint32_t>()),
        count_(domain.aggregated ? centres_.size() : domain.componentOf.size()) {}
  [[nodiscard]] size_t size() const { return count_; }
  [[nodiscard]] uint32_t operator[](size_t i) const {
    return centres_.empty() ? static_cast<uint32_t>(i) : centres_[i];
  }

 private:
  std::span<const uint32_t> centres_;
  size_t count_;
};

std::vector<ComponentValues> componentValues(const FaceDomain& domain, std::span<const double> constraints) {
  const EquationFaces faces(domain);
  const std::vector<uint32_t> known = selectInParallel(
      faces.size(), [&](size_t i) { return faces[i]; },
      [&](uint32_t face) { return std::isfinite(constraints[face]); });
  std::vector<ComponentValues> values(domain.componentCount);
  // In face order, so that the order of the seeds does not change the last bit.
  for (const uint32_t face : known) {
    const double value = constraints[face];
    ComponentValues& component = values[domain.componentOf[face]];
    component.low = std::min(component.low, value);
    component.high = std::max(component.high, value);
    ++component.count;
    component.mean += (value - component.mean) / static_cast<double>(component.count);
  }
  return values;
}

/// Start of the solvers, one entry per node of the equation: the prediction or, where there is none, the mean of the
/// seeds of the component.
std::vector<double> firstGuess(const FaceDomain& domain, const std::vector<ComponentValues>& traced,
                               std::span<const double> prediction) {
  const EquationFaces faces(domain);
  std::vector<double> guess(faces.size(), kNoValue);
  forEachInParallel(faces.size(), [&](uint32_t i) {
    const uint32_t face = faces[i];
    const ComponentValues& component = traced[domain.componentOf[face]];
    if (component.count > 0) guess[i] = component.mean;
    if (!prediction.empty() && std::isfinite(prediction[face])) guess[i] = prediction[face];
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

/// Returns the number of limited faces. predicted: #F, or empty.
uint64_t keepWithinTraced(const FaceDomain& domain, const std::vector<ComponentValues>& traced,
                          std::span<const double> predicted, std::vector<double>& values) {
  const EquationFaces faces(domain);
  return countInParallel(faces.size(), [&](uint32_t i) {
    const uint32_t face = faces[i];
    if (!std::isfinite(values[face])) return false;
    const double prediction = predicted.empty() ? kNoValue : predicted[face];
    const double value = limited(traced[domain.componentOf[face]], prediction, values[face]);
    return std::exchange(values[face], value) != value;
  });
}

}  // namespace

Interpolated Interpolation::solve(std::span<const double> constraints, std::span<const double> predicted,
                                  const RunControl& control) {
  Interpolated result;
  result.solver.name = "none";
  // In CGAL's definition only traced faces have values.
  const bool needsNone = options_.cone.definition == Definition::Cgal && options_.seeds.kind == SeedCount::Kind::All;
  const bool hasAll =
      needsNone || std::all_of(constraints.begin(), constraints.end(), [](double v) { return std::isfinite(v); });
  if (!hasAll) {
    const std::vector<ComponentValues> traced = componentValues(domain_, constraints);
    result.solver = solveEquation(constraints, predicted, traced, result.values, control);
    result.clampedCount = keepWithinTraced(domain_, traced, predicted, result.values);
  } else {
    result.values.assign(constraints.begin(), constraints.end());
  }
  return result;
}

double Interpolation::pooled(double value, double prediction) const {
  return std::isfinite(prediction) && std::isfinite(value)
             ? value + options_.interpolation.pooling * (prediction - value)
             : value;
}

void Interpolation::pool(std::span<const double> predicted, std::vector<double>& values) const {
  if (options_.interpolation.pooling > 0)
    forEachInParallel(predicted.size(), [&](uint32_t face) { values[face] = pooled(values[face], predicted[face]); });
}

std::vector<double> Interpolation::valuesAt(std::span<const uint32_t> faces, std::span<const double> constraints,
                                            std::span<const double> predicted, std::span<const double> solved) {
  const std::vector<ComponentValues> traced = componentValues(domain_, constraints);
  const bool isGuided = options_.interpolation.guidance == Guidance::Prediction;
  const std::vector<double> divergence = this->divergence();
  std::vector<double> values = interpolateLocally(
      {domain_.graph, weights(), constraints, isGuided ? predicted : std::span<const double>(), divergence, solved},
      faces);
  for (size_t i = 0; i < faces.size(); ++i) {
    const double prediction = predicted.empty() ? kNoValue : predicted[faces[i]];
    values[i] = pooled(limited(traced[domain_.componentOf[faces[i]]], prediction, values[i]), prediction);
  }
  return values;
}

std::span<const double> Interpolation::weights() {
  if (weights_.empty())
    weights_ = options_.interpolation.weights == ArcWeights::Feature
                   ? featureWeights(arcAngles_.take())
                   : distanceWeights(domain_.graph, prepared_.geometry);
  return weights_;
}

/// #F, or empty.
std::vector<double> Interpolation::divergence() const {
  if (options_.interpolation.guidance != Guidance::Curvature) return {};
  std::vector<double> divergence = faceCurvature(prepared_.mesh);
  for (double& entry : divergence) entry = -entry;
  return divergence;
}

/// All but the first guess.
GraphProblem Interpolation::problemOf(std::span<const double> constraints, std::span<const double> predicted) const {
  GraphProblem problem{.constraints = constraints,
                       .firstGuess = {},
                       .guide = {},
                       .divergence = divergence(),
                       .componentOf = domain_.componentOf};
  if (options_.interpolation.guidance == Guidance::Prediction) problem.guide = predicted;
  return problem;
}

/// Solves the equation of the aggregates, which has no rows for the other faces. problem: of all faces, without
/// divergence and first guess. guess: one entry per aggregate.
SolverReport Interpolation::solveOnCentres(const GraphProblem& problem, std::vector<double> guess,
                                           std::vector<double>& values, const RunControl& control) {
  const FaceAggregates& aggregates = domain_.aggregated->aggregates();
  const auto atCentres = [&]<typename T>(std::span<const T> perFace) {
    return perFace.empty() ? UnsetVector<T>() : entriesAt<UnsetVector<T>>(aggregates.centres, perFace);
  };
  const UnsetVector<double> constraints = atCentres(problem.constraints), guide = atCentres(problem.guide);
  const UnsetVector<uint32_t> componentOf = atCentres(problem.componentOf);
  std::vector<double> solved;
  const SolverReport report = solver_.solve(aggregates.graph, weights(),
                                            {.constraints = constraints,
                                             .firstGuess = std::move(guess),
                                             .guide = guide,
                                             .divergence = {},
                                             .componentOf = componentOf},
                                            solved, control);
  values.assign(problem.constraints.begin(), problem.constraints.end());
  forEachInParallel(solved.size(),
                    [&](uint32_t aggregate) { values[aggregates.centres[aggregate]] = solved[aggregate]; });
  return report;
}

/// values: receives the constraints and the solution, #F; empty before the call.
SolverReport Interpolation::solveEquation(std::span<const double> constraints, std::span<const double> predicted,
                                          const std::vector<ComponentValues>& traced, std::vector<double>& values,
                                          const RunControl& control) {
  const EquationFaces faces(domain_);
  const uint64_t unknownCount = countInParallel(faces.size(), [&](uint32_t i) {
    return !std::isfinite(constraints[faces[i]]) && traced[domain_.componentOf[faces[i]]].count > 0;
  });
  if (unknownCount == 0) {
    values.assign(constraints.begin(), constraints.end());
    return {.name = "none"};
  }
  GraphProblem problem = problemOf(constraints, predicted);
  std::vector<double> guess = firstGuess(domain_, traced, predicted);
  if (domain_.aggregated != nullptr) return solveOnCentres(problem, std::move(guess), values, control);
  problem.firstGuess = std::move(guess);
  return solver_.solve(domain_.graph, weights(), std::move(problem), values, control);
}

}  // namespace asdfvk
