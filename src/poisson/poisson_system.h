#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "core/unset_vector.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// Dihedral angles at which the weight Feature is 1/2. The shape diameter changes more across sharper edges, and on
/// organic shapes about five times more across concave edges than across convex ones.
inline constexpr double kConcaveScaleDegrees = 3;
inline constexpr double kConvexScaleDegrees = 8;

/// Weights of arcs. The larger the weight of an arc, the closer the interpolated values of its two faces. Both
/// functions return one weight per arc, in the order of graph.neighbours: positive, finite, and with the same bits in
/// both directions.
///
/// ArcWeights::Feature: 1 / (1 + (a / s)^2), where a is the dihedral angle and s is kConcaveScaleDegrees or
/// kConvexScaleDegrees. No unit. arcAngles: see arcAngles().
[[nodiscard]] UnsetVector<double> featureWeights(std::span<const float> arcAngles);
/// ArcWeights::Distance: 1 / distance of the barycentres (ASDF paper, section 4.1). Unit: 1 / length. Distances below
/// 1e-9 of the diagonal of the bounding box are replaced by this bound, which keeps the matrix finite for coincident
/// barycentres.
[[nodiscard]] UnsetVector<double> distanceWeights(const DualGraph& graph, const FaceGeometry& geometry);

/// A u = b for the unknown faces of an interpolation. A is symmetric, positive definite and an M-matrix: its
/// off-diagonal entries are minus the weights. Rows are compressed, columns strictly ascending.
struct PoissonSystem {
  std::vector<uint32_t> faces;        ///< #U: the face of each unknown, ascending.
  std::vector<uint32_t> rowOffsets;   ///< #U+1
  UnsetVector<uint32_t> columns;      ///< Indices of unknowns, without the diagonal.
  UnsetVector<double> entries;        ///< Off-diagonal entries of A, one per column.
  UnsetVector<double> diagonal;       ///< #U, > 0. Includes the weights of constrained neighbours.
  UnsetVector<double> rightHandSide;  ///< #U
  std::vector<double> firstGuess;     ///< #U: start of the solvers; empty: constraintMean everywhere.
  double constraintMean = 0;          ///< Mean of the constraints.

  [[nodiscard]] uint32_t unknownCount() const { return static_cast<uint32_t>(faces.size()); }
};

/// The interpolation of the ASDF paper, section 4.1:
///
///     sum_{g in N(f)} w_fg u(f) - sum_{g in N(f), g unknown} w_fg u(g)
///         = sum_{g in N(f), g constrained} w_fg constraint(g) + divergence(f)
///
/// Without a divergence, u minimises sum w_fg (u_f - u_g)^2, and u stays within the range of the constraints. Faces
/// without a path of arcs to a constraint are not unknowns.
///
/// weights: one per arc, see featureWeights(); > 0, finite, equal in both directions. Several arcs between two faces
/// count as one with the sum of their weights; an arc from a face to itself is ignored. constraints: #F, the value of a
/// constrained face (Dirichlet), NaN elsewhere. divergence: #F, or empty for none; non-finite entries count as 0. For
/// the guidance of the ASDF paper, the divergence is minus the curvature. For guidance by a field, the divergence is
/// divergenceOf(field): if the constraints are values of the field, the field is the solution. componentOf: #F, see
/// Components::componentOf. firstGuess: #F, or empty; non-finite entries are replaced by the constraintMean.
[[nodiscard]] PoissonSystem buildPoissonSystem(const DualGraph& graph, std::span<const double> weights,
                                               std::span<const double> constraints, std::span<const double> divergence,
                                               std::span<const uint32_t> componentOf,
                                               std::span<const double> firstGuess = {});

/// #F: 1 for the faces of components with a finite constraint.
[[nodiscard]] std::vector<uint8_t> reachableFaces(std::span<const uint32_t> componentOf,
                                                  std::span<const double> constraints);
/// Mean of the finite constraints; 0 if there are none.
[[nodiscard]] double meanOfConstraints(std::span<const double> constraints);

/// #F. Entry f is the sum of w_fg (field(f) - field(g)) over the neighbours g of f; terms that are not finite are left
/// out. weights: one per arc.
[[nodiscard]] std::vector<double> divergenceOf(const DualGraph& graph, std::span<const double> weights,
                                               std::span<const double> field);

/// residual = b - A x, in double. solution, residual: #U.
void computeResidual(const PoissonSystem& system, std::span<const double> solution, std::span<double> residual);

/// ||D^-1 r||, D the diagonal of A: the error of each equation in the unit of the values. In ||r||, the large weights
/// of a finely meshed patch would hide errors elsewhere. residual: #U.
[[nodiscard]] double residualNorm(const PoissonSystem& system, std::span<const double> residual);

/// residualNorm() of the right-hand side.
[[nodiscard]] inline double rightHandNorm(const PoissonSystem& system) {
  return residualNorm(system, system.rightHandSide);
}

}  // namespace asdfvk
