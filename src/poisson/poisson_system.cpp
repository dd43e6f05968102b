#include "poisson/poisson_system.h"

#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/ordered_sum.h"
#include "core/parallel.h"
#include "poisson/weighted_graph.h"

namespace asdfvk {
namespace {

constexpr uint32_t kNotUnknown = std::numeric_limits<uint32_t>::max();

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

// The same where it is known which faces hang together.
std::vector<uint8_t> reachedInComponents(std::span<const uint32_t> componentOf, std::span<const double> values) {
  std::vector<uint8_t> isKnown;
  for (size_t face = 0; face < values.size(); ++face) {
    if (componentOf[face] >= isKnown.size()) isKnown.resize(componentOf[face] + size_t{1}, 0);
    if (std::isfinite(values[face])) isKnown[componentOf[face]] = 1;
  }
  std::vector<uint8_t> reached(values.size());
  forEachInParallel(values.size(), [&](size_t face) { reached[face] = isKnown[componentOf[face]]; });
  return reached;
}

double meanOfKnown(std::span<const double> values) {
  const auto count =
      static_cast<size_t>(orderedSum(values.size(), [&](size_t i) { return std::isfinite(values[i]) ? 1.0 : 0.0; }));
  if (count == 0) return 0;
  // Divided before they are added, so that values near the end of the range do not overflow.
  return orderedSum(values.size(),
                    [&](size_t i) { return std::isfinite(values[i]) ? values[i] / static_cast<double>(count) : 0.0; });
}

// Fills everything but the unknown faces and the first guess.
void assemble(const WeightedGraph& graph, std::span<const uint32_t> unknownOf, std::span<const double> values,
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
        rightHandSide += weight * values[neighbour];
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

PoissonSystem buildPoissonSystem(const DualGraph& graph, std::span<const double> weights,
                                 std::span<const double> values, std::span<const double> divergence,
                                 const PoissonOptions& options) {
  const size_t faceCount = graph.faceCount();
  ASDFVK_CHECK_OP(weights.size(), ==, graph.neighbours.size());
  ASDFVK_CHECK_OP(values.size(), ==, faceCount);
  if (!divergence.empty()) ASDFVK_CHECK_OP(divergence.size(), ==, faceCount);
  if (!options.firstGuess.empty()) ASDFVK_CHECK_OP(options.firstGuess.size(), ==, faceCount);
  if (!options.componentOf.empty()) ASDFVK_CHECK_OP(options.componentOf.size(), ==, faceCount);

  PoissonSystem system;
  system.knownMean = meanOfKnown(values);
  const std::vector<uint8_t> reached =
      options.componentOf.empty() ? reachedFromKnown(graph, values) : reachedInComponents(options.componentOf, values);
  std::vector<uint32_t> unknownOf(faceCount, kNotUnknown);
  for (uint32_t face = 0; face < faceCount; ++face)
    if (reached[face] && !std::isfinite(values[face])) {
      unknownOf[face] = system.unknownCount();
      system.faces.push_back(face);
    }
  if (!options.firstGuess.empty()) {
    system.firstGuess.resize(system.faces.size());
    forEachInParallel(system.faces.size(), [&](size_t row) {
      const double guess = options.firstGuess[system.faces[row]];
      system.firstGuess[row] = std::isfinite(guess) ? guess : system.knownMean;
    });
  }
  assemble({graph, weights}, unknownOf, values, divergence, system);
  return system;
}

}  // namespace asdfvk
