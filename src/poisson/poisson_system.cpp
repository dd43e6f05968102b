#include "poisson/poisson_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "poisson/each_row.h"
#include "poisson/ordered_sum.h"

namespace asdfvk {
namespace {

constexpr uint32_t kNotUnknown = std::numeric_limits<uint32_t>::max();
constexpr double kShortestDistanceRatio = 1e-9;
constexpr double kShortestDistance = 1e-300;  // Keeps weights finite where even the diagonal is next to nothing.

// std::hypot neither overflows nor underflows, whatever the mesh's unit.
double extent(const Vec3d& v) { return std::hypot(v.x, v.y, v.z); }

struct Arcs {
  const DualGraph& graph;
  const FaceGeometry& geometry;
  double shortestDistance;

  /// Calls visit(g, w_fg) for each neighbour in ascending order; a neighbour over two edges comes once, its weight
  /// doubled.
  template <typename Visit>
  void visit(uint32_t face, const Visit& visit) const {
    const std::span<const uint32_t> neighbours = graph.neighboursOf(face);
    for (size_t i = 0; i < neighbours.size();) {
      const uint32_t neighbour = neighbours[i];
      const size_t first = i;
      while (i < neighbours.size() && neighbours[i] == neighbour) ++i;
      if (neighbour == face) continue;
      const Vec3d between = geometry.barycentres[neighbour] - geometry.barycentres[face];
      visit(neighbour, static_cast<double>(i - first) / std::max(extent(between), shortestDistance));
    }
  }
};

// Breadth first from the known faces; true where a face is known or joined to one.
std::vector<uint8_t> reachedFromKnown(const DualGraph& graph, std::span<const double> values) {
  std::vector<uint8_t> reached(graph.faceCount(), 0);
  std::vector<uint32_t> queue;
  queue.reserve(graph.faceCount());
  for (uint32_t face = 0; face < graph.faceCount(); ++face)
    if (std::isfinite(values[face])) {
      reached[face] = 1;
      queue.push_back(face);
    }
  for (size_t next = 0; next < queue.size(); ++next)
    for (uint32_t neighbour : graph.neighboursOf(queue[next]))
      if (!reached[neighbour]) {
        reached[neighbour] = 1;
        queue.push_back(neighbour);
      }
  return reached;
}

double meanOfKnown(std::span<const double> values) {
  size_t count = 0;
  for (double value : values) count += std::isfinite(value) ? 1 : 0;
  if (count == 0) return 0;
  // Divided before they are added, so that values near the end of the range do not overflow.
  return orderedSum(values.size(),
                    [&](size_t i) { return std::isfinite(values[i]) ? values[i] / static_cast<double>(count) : 0.0; });
}

}  // namespace

PoissonSystem buildPoissonSystem(const DualGraph& graph, const FaceGeometry& geometry, std::span<const double> values,
                                 std::span<const double> curvature, double guidance) {
  const size_t faceCount = graph.faceCount();
  ASDFVK_CHECK_OP(values.size(), ==, faceCount);
  ASDFVK_CHECK_OP(geometry.barycentres.size(), ==, faceCount);
  if (guidance != 0) ASDFVK_CHECK_OP(curvature.size(), ==, faceCount);

  PoissonSystem system;
  system.knownMean = meanOfKnown(values);
  const std::vector<uint8_t> reached = reachedFromKnown(graph, values);
  std::vector<uint32_t> unknownOf(faceCount, kNotUnknown);
  for (uint32_t face = 0; face < faceCount; ++face)
    if (reached[face] && !std::isfinite(values[face])) {
      unknownOf[face] = system.unknownCount();
      system.faces.push_back(face);
    }

  const Arcs arcs{graph, geometry,
                  std::max(kShortestDistanceRatio * extent(geometry.bounds.size()), kShortestDistance)};
  const size_t unknownCount = system.faces.size();
  system.rowOffsets.assign(unknownCount + 1, 0);
  forEachRow(unknownCount, [&](size_t row) {
    uint32_t count = 0;
    arcs.visit(system.faces[row], [&](uint32_t g, double) { count += unknownOf[g] != kNotUnknown ? 1 : 0; });
    system.rowOffsets[row + 1] = count;
  });
  for (size_t row = 0; row < unknownCount; ++row) {
    ASDFVK_CHECK_OP(system.rowOffsets[row + 1], <=, kNotUnknown - system.rowOffsets[row]);
    system.rowOffsets[row + 1] += system.rowOffsets[row];
  }
  system.columns.resize(system.rowOffsets.back());
  system.weights.resize(system.rowOffsets.back());
  system.diagonal.resize(unknownCount);
  system.rightHandSide.resize(unknownCount);
  forEachRow(unknownCount, [&](size_t row) {
    const uint32_t face = system.faces[row];
    uint32_t next = system.rowOffsets[row];
    double diagonal = 0, rightHandSide = 0;
    if (guidance != 0 && std::isfinite(curvature[face])) rightHandSide = -guidance * curvature[face];
    arcs.visit(face, [&](uint32_t neighbour, double weight) {
      diagonal += weight;
      if (unknownOf[neighbour] == kNotUnknown) {
        rightHandSide += weight * values[neighbour];
      } else {
        system.columns[next] = unknownOf[neighbour];
        system.weights[next++] = weight;
      }
    });
    system.diagonal[row] = diagonal;
    system.rightHandSide[row] = rightHandSide;
  });
  return system;
}

void computeResidual(const PoissonSystem& system, std::span<const double> solution, std::span<double> residual) {
  ASDFVK_CHECK_OP(solution.size(), ==, system.faces.size());
  ASDFVK_CHECK_OP(residual.size(), ==, system.faces.size());
  forEachRow(system.faces.size(), [&](size_t row) {
    double sum = system.rightHandSide[row] - system.diagonal[row] * solution[row];
    for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i)
      sum += system.weights[i] * solution[system.columns[i]];
    residual[row] = sum;
  });
}

double residualNorm(const PoissonSystem& system, std::span<const double> residual) {
  return orderedNorm(residual.size(), [&](size_t row) { return residual[row] / system.diagonal[row]; });
}

double relativeResidual(const PoissonSystem& system, std::span<const double> solution) {
  std::vector<double> residual(solution.size());
  computeResidual(system, solution, residual);
  const double norm = residualNorm(system, residual);
  return norm == 0 ? 0 : norm / residualNorm(system, system.rightHandSide);
}

}  // namespace asdfvk
