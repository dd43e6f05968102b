#include "segment/alpha_expansion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"

namespace asdfvk {
namespace {

constexpr double kMinRelativeDecrease = 1e-10;
/// Number of labels whose flows are kept, 8 bytes per edge and label.
constexpr uint32_t kKeptFlowCount = 8;
constexpr uint32_t kNoNode = std::numeric_limits<uint32_t>::max();

}  // namespace

double labelEnergy(const LabelProblem& problem, std::span<const uint32_t> labels) {
  double energy = 0;
  for (uint32_t face = 0; face < labels.size(); ++face) energy += problem.dataCost(face, labels[face]);
  for (const LabelEdge& edge : problem.edges)
    if (labels[edge.f] != labels[edge.g]) energy += edge.cost;
  return energy;
}

double AlphaExpansion::minimize(const LabelProblem& problem, std::span<uint32_t> labels, const Limits& limits,
                                const RunControl& control) {
  const RunControl stopOnly = control.withoutProgress();
  ASDFVK_CHECK_OP(labels.size(), ==, problem.faceCount());
  double energy = labelEnergy(problem, labels);
  ASDFVK_CHECK(std::isfinite(energy));
  const uint32_t labelCount = std::min(limits.expandedLabelCount, problem.labelCount);
  const bool mayRepeat = labelCount > 1 && limits.maxRoundCount > 1;
  flows_.assign(mayRepeat ? std::min(labelCount, kKeptFlowCount) : 0, std::vector<double>(problem.edges.size(), 0));
  // An expansion is optimal for its label. Therefore a repeated expansion changes nothing if no other expansion has
  // changed a face in the meantime.
  uint32_t unchangedCount = 0;
  for (uint32_t round = 0; round < limits.maxRoundCount; ++round)
    for (uint32_t label = 0; label < labelCount; ++label) {
      if (unchangedCount == labelCount) return energy;
      ++unchangedCount;
      stopOnly.checkpoint(0);
      if (!expand(problem, labels, label, stopOnly)) continue;
      const double lower = labelEnergy(problem, expanded_);
      if (!(energy - lower > kMinRelativeDecrease * std::abs(energy))) continue;
      std::copy(expanded_.begin(), expanded_.end(), labels.begin());
      energy = lower;
      unchangedCount = 1;
    }
  return energy;
}

// Nodes on the side of the source take the label. Let x be 1 for such nodes and 0 for the others, and w the cost of the
// edge of f and g. If the labels of f and g are equal, the edge costs w if x_f and x_g differ: capacity w in both
// directions. If the labels differ, the edge costs 0 for x_f = x_g = 1, and w otherwise. This cost equals w - w/2 (x_f
// + x_g), plus w/2 if x_f and x_g differ.
bool AlphaExpansion::expand(const LabelProblem& problem, std::span<const uint32_t> labels, uint32_t label,
                            const RunControl& stopOnly) {
  nodeOf_.resize(labels.size());
  uint32_t nodeCount = 0;
  for (uint32_t face = 0; face < labels.size(); ++face) {
    const bool canChange = labels[face] != label && std::isfinite(problem.dataCost(face, label));
    nodeOf_[face] = canChange ? nodeCount++ : kNoNode;
  }
  flow_.reset(nodeCount);
  for (uint32_t face = 0; face < labels.size(); ++face)
    if (nodeOf_[face] != kNoNode)
      flow_.addTerminal(nodeOf_[face], problem.dataCost(face, labels[face]) - problem.dataCost(face, label));
  const std::span<double> flows = label < flows_.size() ? std::span(flows_[label]) : std::span<double>();
  for (size_t e = 0; e < problem.edges.size(); ++e) {
    const LabelEdge& edge = problem.edges[e];
    const uint32_t f = nodeOf_[edge.f], g = nodeOf_[edge.g];
    const double earlierFlow = flows.empty() ? 0 : std::exchange(flows[e], 0);
    const bool isUncut = labels[edge.f] == labels[edge.g];
    if (f != kNoNode && g != kNoNode) {
      const double capacity = isUncut ? edge.cost : edge.cost / 2;
      if (capacity == 0) continue;
      flow_.addEdge(f, g, capacity, capacity, std::clamp(earlierFlow, -capacity, capacity));
      if (!isUncut) {
        flow_.addTerminal(f, capacity);
        flow_.addTerminal(g, capacity);
      }
      if (!flows.empty()) flows[e] = capacity;
    } else if (f != kNoNode || g != kNoNode) {
      // The other face keeps its label.
      const uint32_t node = f != kNoNode ? f : g;
      if (isUncut)
        flow_.addTerminal(node, -edge.cost);
      else if (labels[f != kNoNode ? edge.g : edge.f] == label)
        flow_.addTerminal(node, edge.cost);
    }
  }
  static_cast<void>(flow_.solve(stopOnly));
  // So far, `flows` has the capacities of the edges of the graph, and 0 for the others.
  size_t edgeCount = 0;
  for (double& flow : flows)
    if (flow > 0) flow -= flow_.residual(edgeCount++);
  bool isChanged = false;
  expanded_.assign(labels.begin(), labels.end());
  for (uint32_t face = 0; face < labels.size(); ++face)
    if (nodeOf_[face] != kNoNode && flow_.isSource(nodeOf_[face])) {
      expanded_[face] = label;
      isChanged = true;
    }
  return isChanged;
}

}  // namespace asdfvk
