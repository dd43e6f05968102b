#include "poisson/poisson_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/check.h"
#include "core/ordered_sum.h"
#include "core/parallel.h"
#include "core/raise_flag.h"
#include "core/vec3.h"

namespace asdfvk {
namespace {

constexpr double kMinDistanceRatio = 1e-9;
constexpr double kMinDistance = 1e-300;  // Least distance, for meshes whose diagonal is almost 0.
constexpr double kMinWeight = std::numeric_limits<double>::min();  // Least weight, for distances that overflow.

double featureWeight(double dihedralAngleRadians) {
  const double degrees = dihedralAngleRadians * (180 / std::numbers::pi);
  const double ratio = degrees / (degrees > 0 ? kConcaveScaleDegrees : kConvexScaleDegrees);
  return 1 / (1 + ratio * ratio);
}

constexpr uint32_t kNotUnknown = std::numeric_limits<uint32_t>::max();

struct WeightedGraph {
  const DualGraph& graph;
  std::span<const double> weights;

  /// Calls visit(g, w_fg) once for each neighbour g of face f, in ascending order, without f itself. w_fg is the sum of
  /// the weights of the arcs from f to g.
  template <typename Visit>
  void visitNeighbours(uint32_t face, const Visit& visit) const {
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1];) {
      const uint32_t neighbour = graph.neighbours[arc];
      double weight = 0;
      for (; arc < graph.offsets[face + 1] && graph.neighbours[arc] == neighbour; ++arc) weight += weights[arc];
      if (neighbour != face) visit(neighbour, weight);
    }
  }
};

double finiteOrZero(std::span<const double> perFace, uint32_t face) {
  return !perFace.empty() && std::isfinite(perFace[face]) ? perFace[face] : 0;
}

/// Fills `system` except faces, firstGuess and constraintMean. unknownOf: #F, kNotUnknown for faces that are not
/// unknowns.
void assemble(const WeightedGraph& graph, std::span<const uint32_t> unknownOf, std::span<const double> constraints,
              std::span<const double> divergence, PoissonSystem& system) {
  const size_t unknownCount = system.faces.size();
  system.rowOffsets.assign(unknownCount + 1, 0);
  forEachInParallel(unknownCount, [&](size_t row) {
    uint32_t count = 0;
    graph.visitNeighbours(system.faces[row],
                          [&](uint32_t neighbour, double) { count += unknownOf[neighbour] != kNotUnknown ? 1 : 0; });
    system.rowOffsets[row + 1] = count;
  });
  for (size_t row = 0; row < unknownCount; ++row) {
    ASDFVK_CHECK_OP(system.rowOffsets[row + 1], <=, kNotUnknown - system.rowOffsets[row]);
    system.rowOffsets[row + 1] += system.rowOffsets[row];
  }
  system.columns.resize(system.rowOffsets.back());
  system.entries.resize(system.rowOffsets.back());
  system.diagonal.resize(unknownCount);
  system.rightHandSide.resize(unknownCount);
  forEachInParallel(unknownCount, [&](size_t row) {
    uint32_t next = system.rowOffsets[row];
    double diagonal = 0, rightHandSide = finiteOrZero(divergence, system.faces[row]);
    graph.visitNeighbours(system.faces[row], [&](uint32_t neighbour, double weight) {
      diagonal += weight;
      if (unknownOf[neighbour] == kNotUnknown) {
        rightHandSide += weight * constraints[neighbour];
      } else {
        system.columns[next] = unknownOf[neighbour];
        system.entries[next++] = -weight;
      }
    });
    system.diagonal[row] = diagonal;
    system.rightHandSide[row] = rightHandSide;
  });
}

}  // namespace

UnsetVector<double> featureWeights(std::span<const float> arcAngles) {
  UnsetVector<double> weights(arcAngles.size());
  forEachInParallel(weights.size(), [&](size_t arc) { weights[arc] = featureWeight(arcAngles[arc]); });
  return weights;
}

UnsetVector<double> distanceWeights(const DualGraph& graph, const FaceGeometry& geometry) {
  ASDFVK_CHECK_OP(geometry.barycentres.size(), ==, size_t{graph.faceCount()});
  UnsetVector<double> weights(graph.neighbours.size());
  const double minDistance = std::max(kMinDistanceRatio * lengthInAnyUnit(geometry.bounds.size()), kMinDistance);
  forEachInParallel(graph.faceCount(), [&](uint32_t face) {
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
      // The difference of the halves does not overflow.
      const Vec3d half = geometry.barycentres[graph.neighbours[arc]] * 0.5 - geometry.barycentres[face] * 0.5;
      weights[arc] = std::max(1 / std::max(2 * lengthInAnyUnit(half), minDistance), kMinWeight);
    }
  });
  return weights;
}

std::vector<uint8_t> reachableFaces(std::span<const uint32_t> componentOf, std::span<const double> constraints) {
  const size_t componentCount =
      maxInParallel<size_t>(componentOf.size(), [&](uint32_t face) { return componentOf[face] + size_t{1}; });
  std::vector<uint8_t> isConstrained(componentCount, 0);
  forEachInParallel(constraints.size(), [&](size_t face) {
    if (std::isfinite(constraints[face])) raiseFlag(isConstrained[componentOf[face]]);
  });
  std::vector<uint8_t> isReachable(constraints.size());
  forEachInParallel(constraints.size(), [&](size_t face) { isReachable[face] = isConstrained[componentOf[face]]; });
  return isReachable;
}

double meanOfConstraints(std::span<const double> constraints) {
  const auto count = static_cast<size_t>(
      orderedSum(constraints.size(), [&](size_t i) { return std::isfinite(constraints[i]) ? 1.0 : 0.0; }));
  if (count == 0) return 0;
  // Divides before adding, so that values near the largest number do not overflow.
  return orderedSum(constraints.size(), [&](size_t i) {
    return std::isfinite(constraints[i]) ? constraints[i] / static_cast<double>(count) : 0.0;
  });
}

PoissonSystem buildPoissonSystem(const DualGraph& graph, std::span<const double> weights,
                                 std::span<const double> constraints, std::span<const double> divergence,
                                 std::span<const uint32_t> componentOf, std::span<const double> firstGuess) {
  const size_t faceCount = graph.faceCount();
  ASDFVK_CHECK_OP(weights.size(), ==, graph.neighbours.size());
  ASDFVK_CHECK_OP(constraints.size(), ==, faceCount);
  if (!divergence.empty()) ASDFVK_CHECK_OP(divergence.size(), ==, faceCount);
  if (!firstGuess.empty()) ASDFVK_CHECK_OP(firstGuess.size(), ==, faceCount);
  ASDFVK_CHECK_OP(componentOf.size(), ==, faceCount);

  PoissonSystem system;
  system.constraintMean = meanOfConstraints(constraints);
  const std::vector<uint8_t> isReachable = reachableFaces(componentOf, constraints);
  std::vector<uint32_t> unknownOf(faceCount, kNotUnknown);
  for (uint32_t face = 0; face < faceCount; ++face)
    if (isReachable[face] && !std::isfinite(constraints[face])) {
      unknownOf[face] = system.unknownCount();
      system.faces.push_back(face);
    }
  if (!firstGuess.empty()) {
    system.firstGuess.resize(system.faces.size());
    forEachInParallel(system.faces.size(), [&](size_t row) {
      const double guess = firstGuess[system.faces[row]];
      system.firstGuess[row] = std::isfinite(guess) ? guess : system.constraintMean;
    });
  }
  assemble({graph, weights}, unknownOf, constraints, divergence, system);
  return system;
}

std::vector<double> divergenceOf(const DualGraph& graph, std::span<const double> weights,
                                 std::span<const double> field) {
  ASDFVK_CHECK_OP(weights.size(), ==, graph.neighbours.size());
  ASDFVK_CHECK_OP(field.size(), ==, size_t{graph.faceCount()});
  const WeightedGraph weighted{graph, weights};
  std::vector<double> divergence(field.size(), 0.0);
  forEachInParallel(field.size(), [&](size_t face) {
    if (!std::isfinite(field[face])) return;
    weighted.visitNeighbours(static_cast<uint32_t>(face), [&](uint32_t neighbour, double weight) {
      if (std::isfinite(field[neighbour])) divergence[face] += weight * (field[face] - field[neighbour]);
    });
  });
  return divergence;
}

void computeResidual(const PoissonSystem& system, std::span<const double> solution, std::span<double> residual) {
  ASDFVK_CHECK_OP(solution.size(), ==, system.faces.size());
  ASDFVK_CHECK_OP(residual.size(), ==, system.faces.size());
  forEachInParallel(system.faces.size(), [&](size_t row) {
    double sum = system.rightHandSide[row] - system.diagonal[row] * solution[row];
    for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i)
      sum -= system.entries[i] * solution[system.columns[i]];
    residual[row] = sum;
  });
}

double residualNorm(const PoissonSystem& system, std::span<const double> residual) {
  return orderedNorm(residual.size(), [&](size_t row) { return residual[row] / system.diagonal[row]; });
}

}  // namespace asdfvk
