#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"

namespace asdfvk {

/// Input of one interpolation on a dual graph, as buildPoissonSystem() has it.
struct GraphProblem {
  std::span<const double> constraints;    ///< #F, NaN for a face without one.
  std::span<const double> divergence;     ///< #F, or empty for none; non-finite entries count as 0.
  std::span<const double> firstGuess;     ///< #F; non-finite entries are replaced by the mean of the constraints.
  std::span<const uint32_t> componentOf;  ///< #F
};

/// The equation of buildPoissonSystem() over all faces instead of over the unknown ones, for solvers whose matrix is
/// the same for all constraints. Faces that are not unknown have a residual of 0 and keep their values: the constraint,
/// or 0 where no path leads to one. Vectors are #F.
class GraphEquation {
 public:
  /// weights: one per arc, see buildPoissonSystem(). diagonal: #F, wholePoissonSystem().diagonal. All arguments must
  /// outlive it.
  GraphEquation(const DualGraph& graph, std::span<const double> weights, std::span<const double> diagonal,
                const GraphProblem& problem);

  [[nodiscard]] size_t size() const { return isUnknown_.size(); }
  [[nodiscard]] bool isUnknown(uint32_t face) const { return isUnknown_[face] != 0; }

  void setFirstGuess(std::span<double> values) const;
  /// In double, from differences of values.
  void computeResidual(std::span<const double> values, std::span<double> residual) const;
  /// As residualNorm() of poisson_system.h.
  [[nodiscard]] double residualNorm(std::span<const double> residual) const;
  [[nodiscard]] double rightHandNorm() const { return rightHandNorm_; }

 private:
  void setKnown(std::span<double> values) const;

  const DualGraph& graph_;
  std::span<const double> weights_, diagonal_;
  GraphProblem problem_;
  std::vector<uint8_t> isUnknown_;
  double constraintMean_ = 0, rightHandNorm_ = 0;
};

// For solveByRefinement().
inline void setFirstGuess(const GraphEquation& equation, std::span<double> values) { equation.setFirstGuess(values); }
inline void computeResidual(const GraphEquation& equation, std::span<const double> values, std::span<double> residual) {
  equation.computeResidual(values, residual);
}
[[nodiscard]] inline double residualNorm(const GraphEquation& equation, std::span<const double> residual) {
  return equation.residualNorm(residual);
}
[[nodiscard]] inline double rightHandNorm(const GraphEquation& equation) { return equation.rightHandNorm(); }

}  // namespace asdfvk
