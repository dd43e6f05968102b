#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "plain_max_flow.h"
#include "segment/alpha_expansion.h"

namespace asdfvk::test {

/// The twin of AlphaExpansion: the graph of Boykov, Veksler and Zabih with a node for every face and an auxiliary node
/// for every edge between different labels, and rounds over all labels until one changes nothing.
inline double minimizeSlowly(const LabelProblem& problem, std::vector<uint32_t>& labels, uint32_t expandedLabelCount) {
  constexpr double kInfinite = 1e12;
  double energy = labelEnergy(problem, labels);
  for (bool isChanged = true; isChanged;) {
    isChanged = false;
    for (uint32_t label = 0; label < expandedLabelCount; ++label) {
      uint32_t nodeCount = problem.faceCount();
      for (const LabelEdge& edge : problem.edges) nodeCount += labels[edge.f] != labels[edge.g] ? 1 : 0;
      // The source's side takes the label.
      PlainMaxFlow flow(nodeCount);
      for (uint32_t face = 0; face < problem.faceCount(); ++face) {
        const double keeping = labels[face] == label ? kInfinite : problem.dataCost(face, labels[face]);
        flow.addTerminal(face, keeping, std::min(kInfinite, problem.dataCost(face, label)));
      }
      uint32_t auxiliary = problem.faceCount();
      for (const LabelEdge& edge : problem.edges) {
        if (labels[edge.f] == labels[edge.g]) {
          flow.addEdge(edge.f, edge.g, edge.cost, edge.cost);
          continue;
        }
        flow.addTerminal(auxiliary, edge.cost, 0);
        for (const uint32_t face : {edge.f, edge.g}) {
          const double cost = labels[face] == label ? 0 : edge.cost;
          flow.addEdge(face, auxiliary, cost, cost);
        }
        ++auxiliary;
      }
      flow.solve();
      std::vector<uint32_t> expanded = labels;
      for (uint32_t face = 0; face < problem.faceCount(); ++face)
        if (flow.isSource(face)) expanded[face] = label;
      const double lower = labelEnergy(problem, expanded);
      if (energy - lower > 1e-10 * energy) {
        energy = lower;
        labels = expanded;
        isChanged = true;
      }
    }
  }
  return energy;
}

}  // namespace asdfvk::test
