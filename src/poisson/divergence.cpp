#include "poisson/divergence.h"

#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "poisson/weighted_graph.h"

namespace asdfvk {

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

}  // namespace asdfvk
