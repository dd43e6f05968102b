#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/unset_vector.h"
#include "mesh/dual_graph.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// A u = b for the unknown faces of an interpolation. A is symmetric, positive definite and an M-matrix: its
/// off-diagonal entries are minus the weights. Rows are compressed, columns strictly ascending.
struct PoissonSystem {
  std::vector<uint32_t> faces;        ///< #U: the face of each unknown, ascending.
  std::vector<uint32_t> rowOffsets;   ///< #U+1
  UnsetVector<uint32_t> columns;      ///< Unknown indices, without the row's own.
  UnsetVector<double> entries;        ///< Off-diagonal ones of A, one per column.
  UnsetVector<double> diagonal;       ///< #U, > 0. Also what the known neighbours take part in.
  UnsetVector<double> rightHandSide;  ///< #U
  std::vector<double> firstGuess;     ///< #U, or empty: knownMean everywhere. Where the solvers start.
  double knownMean = 0;               ///< Mean of the known values.

  [[nodiscard]] uint32_t unknownCount() const { return static_cast<uint32_t>(faces.size()); }
};

struct PoissonOptions {
  /// #F, or empty. Where it is not finite the mean of the known values stands in.
  std::span<const double> firstGuess;
  /// #F, Components::componentOf, or empty: then it is found out which faces hang together.
  std::span<const uint32_t> componentOf;
};

/// The interpolation of the ASDF paper, section 4.1, over the dual graph:
///
///     sum_{g in N(f)} w_fg u(f) - sum_{g in N(f), g unknown} w_fg u(g)
///         = sum_{g in N(f), g known} w_fg value(g) + divergence(f)
///
/// which minimises sum w_fg (u_f - u_g)^2 if there is no divergence; then u stays within the range of the known values.
/// Faces that no path of arcs joins to a known one are left out.
///
/// weights: one per arc, see arcWeights(); > 0, finite, the same both ways (two arcs to the same face count as one with
/// the sum of their weights). values: #F, finite where the face is known (a Dirichlet constraint), NaN where it is not.
/// divergence: #F, or empty for none; non-finite entries count as 0. It is -curv for the paper's guidance by
/// curvature, and divergenceOf(field) for guidance by any field: if the known values are the field's, it is the
/// solution.
[[nodiscard]] PoissonSystem buildPoissonSystem(const DualGraph& graph, std::span<const double> weights,
                                               std::span<const double> values, std::span<const double> divergence,
                                               const PoissonOptions& options = {});

/// residual = b - A x, in double. solution, residual: #U.
void computeResidual(const PoissonSystem& system, std::span<const double> solution, std::span<double> residual);

/// ||D^-1 r||, D the diagonal of A: what each face's equation is off by, in the unit of the values. Unlike ||r|| it
/// does not let the large weights of a finely meshed patch hide what is wrong elsewhere. residual: #U.
[[nodiscard]] double residualNorm(const PoissonSystem& system, std::span<const double> residual);

/// ||D^-1 (b - A x)|| / ||D^-1 b|| in double; 0 for an empty system and wherever the residual is 0, infinite where only
/// b is.
[[nodiscard]] double relativeResidual(const PoissonSystem& system, std::span<const double> solution);

}  // namespace asdfvk
