#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "mesh/arc_angles.h"
#include "mesh/face_domain.h"
#include "pipeline/equation_solver.h"

namespace asdfvk {

/// Values of all nodes of a domain, interpolated from the values of the seeds.
struct Interpolated {
  std::vector<double> values;  ///< #N; NaN in components without any value.
  SolverReport solver;         ///< The name of the solver is "none" if there was nothing to solve.
  uint64_t clampedCount = 0;   ///< Nodes whose solution was limited to the range of the values of the seeds.
};

/// Traced values of one component. Components are separate because parts of one mesh may differ in size by any factor.
struct ComponentValues {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  double mean = 0;
  uint64_t count = 0;
};

/// Interpolation on one domain of a mesh, for any sets of seeds.
class Interpolation {
 public:
  /// The arguments must outlive this object.
  Interpolation(const FaceDomain& domain, const TriangleMesh& mesh, ArcAngles& arcAngles, const Options& options,
                EquationSolver& solver)
      : domain_(domain), mesh_(mesh), arcAngles_(arcAngles), options_(options), solver_(solver) {}

  /// constraints: #N, NaN where a value is unknown. predicted: #N, or empty: the prediction that guides the solution
  /// with Guidance::Prediction. The values are not pooled yet.
  [[nodiscard]] Interpolated solve(std::vector<double> constraints, std::span<const double> predicted,
                                   const RunControl& control);
  /// The pooled values of `nodes` with these constraints and this prediction; see interpolateLocally(). solved: the
  /// result of solve() with more constraints. Returns #nodes.
  [[nodiscard]] std::vector<double> valuesAt(std::span<const uint32_t> nodes, std::span<const double> constraints,
                                             std::span<const double> predicted, std::span<const double> solved);
  /// Moves `values`, results of solve(), towards the prediction by the share InterpolationOptions::pooling.
  void pool(std::span<const double> predicted, std::vector<double>& values) const;

 private:
  [[nodiscard]] std::span<const double> weights();
  [[nodiscard]] double pooled(double value, double prediction) const;
  [[nodiscard]] std::vector<double> divergence() const;
  SolverReport solveEquation(std::span<const double> constraints, std::span<const double> predicted,
                             const std::vector<ComponentValues>& traced, std::vector<double>& values,
                             const RunControl& control);

  const FaceDomain& domain_;
  const TriangleMesh& mesh_;
  ArcAngles& arcAngles_;
  const Options& options_;
  EquationSolver& solver_;
  UnsetVector<double> weights_;  ///< One per arc of the dual graph; computed at first use, so that they take no memory
                                 ///< while rays are traced.
};

}  // namespace asdfvk
