#include "poisson/graph_equation.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/ordered_sum.h"
#include "core/parallel.h"
#include "poisson/poisson_system.h"

namespace asdfvk {

GraphEquation::GraphEquation(const DualGraph& graph, std::span<const double> weights, std::span<const double> diagonal,
                             const GraphProblem& problem)
    : graph_(graph),
      weights_(weights),
      diagonal_(diagonal),
      problem_(problem),
      isUnknown_(reachableFaces(problem.componentOf, problem.constraints)),
      constraintMean_(meanOfConstraints(problem.constraints)) {
  ASDFVK_CHECK_OP(weights.size(), ==, graph.neighbours.size());
  for (const size_t count : {diagonal.size(), problem.constraints.size(), problem.firstGuess.size()})
    ASDFVK_CHECK_OP(count, ==, size_t{graph.faceCount()});
  if (!problem.divergence.empty()) ASDFVK_CHECK_OP(problem.divergence.size(), ==, size_t{graph.faceCount()});
  forEachInParallel(size(), [&](uint32_t face) {
    if (std::isfinite(problem.constraints[face])) isUnknown_[face] = 0;
  });
  // The right-hand side is the residual of unknowns of 0.
  std::vector<double> values(size(), 0.0), residual(size());
  setKnown(values);
  computeResidual(values, residual);
  rightHandNorm_ = residualNorm(residual);
}

void GraphEquation::setKnown(std::span<double> values) const {
  forEachInParallel(size(), [&](uint32_t face) {
    if (!isUnknown(face)) values[face] = std::isfinite(problem_.constraints[face]) ? problem_.constraints[face] : 0;
  });
}

void GraphEquation::setFirstGuess(std::span<double> values) const {
  forEachInParallel(size(), [&](uint32_t face) {
    const double guess = problem_.firstGuess[face];
    values[face] = std::isfinite(guess) ? guess : constraintMean_;
  });
  setKnown(values);
}

void GraphEquation::computeResidual(std::span<const double> values, std::span<double> residual) const {
  forEachInParallel(size(), [&](uint32_t face) {
    residual[face] = 0;
    if (!isUnknown(face)) return;
    double sum =
        !problem_.divergence.empty() && std::isfinite(problem_.divergence[face]) ? problem_.divergence[face] : 0;
    for (uint32_t arc = graph_.offsets[face]; arc < graph_.offsets[face + 1]; ++arc)
      sum += weights_[arc] * (values[graph_.neighbours[arc]] - values[face]);
    residual[face] = sum;
  });
}

double GraphEquation::residualNorm(std::span<const double> residual) const {
  return orderedNorm(size(), [&](size_t face) { return residual[face] / diagonal_[face]; });
}

}  // namespace asdfvk
