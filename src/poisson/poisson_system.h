#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// The interpolation of the ASDF paper, section 4.1, over the dual graph with weights 1 / distance of barycentres:
///
///     sum_{g in N(f)} w_fg u(f) - sum_{g in N(f), g unknown} w_fg u(g) = sum_{g in N(f), g known} w_fg value(g) - k
///     curv(f)
///
/// Symmetric and positive definite: faces that no path of arcs joins to a known face are left out. Rows are compressed,
/// columns strictly ascending (two arcs to the same face are one entry with the sum of their weights); the matrix entry
/// of an off-diagonal arc is minus its weight.
struct PoissonSystem {
  std::vector<uint32_t> faces;        ///< #U: the face of each unknown, ascending.
  std::vector<uint32_t> rowOffsets;   ///< #U+1
  std::vector<uint32_t> columns;      ///< Unknown indices.
  std::vector<double> weights;        ///< w_fg > 0, one per column.
  std::vector<double> diagonal;       ///< #U, the sum of w_fg over all of N(f).
  std::vector<double> rightHandSide;  ///< #U
  double knownMean = 0;               ///< Mean of the known values: the solvers' first guess.

  [[nodiscard]] uint32_t unknownCount() const { return static_cast<uint32_t>(faces.size()); }
};

/// values: #F, finite where the face is known (a Dirichlet constraint), NaN where it is not. curvature: #F, non-finite
/// entries count as 0; or empty when guidance is 0. Distances below 1e-9 of the box's diagonal count as that, so that
/// coincident barycentres keep the matrix finite.
[[nodiscard]] PoissonSystem buildPoissonSystem(const DualGraph& graph, const FaceGeometry& geometry,
                                               std::span<const double> values, std::span<const double> curvature,
                                               double guidance);

/// residual = b - A x, in double. solution, residual: #U.
void computeResidual(const PoissonSystem& system, std::span<const double> solution, std::span<double> residual);

/// ||D^-1 r||, D the diagonal of A: what each face's equation is off by, in the unit of the values. Unlike ||r|| it
/// does not let the large weights of a finely meshed patch hide what is wrong elsewhere. residual: #U.
[[nodiscard]] double residualNorm(const PoissonSystem& system, std::span<const double> residual);

/// ||D^-1 (b - A x)|| / ||D^-1 b|| in double; 0 for an empty system and wherever the residual is 0, infinite where only
/// b is.
[[nodiscard]] double relativeResidual(const PoissonSystem& system, std::span<const double> solution);

}  // namespace asdfvk
