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
  flows_.assign(labelCount > 1 && limits.maxRoundCount > 1 ? std::min(labelCount, kKeptFlowCount) : 0, {});
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
  gains_.clear();
  for (uint32_t face = 0; face < labels.size(); ++face) {
    const double cost = problem.dataCost(face, label);
    const bool canChange = labels[face] != label && std::isfinite(cost);
    nodeOf_[face] = canChange ? static_cast<uint32_t>(gains_.size()) : kNoNode;
    if (canChange) gains_.emplace_back().add(problem.dataCost(face, labels[face]) - cost);
  }
  flow_.reset(static_cast<uint32_t>(gains_.size()));
  const bool keepsFlow = label < flows_.size(), hasFlow = keepsFlow && !flows_[label].empty();
  if (keepsFlow) flows_[label].resize(problem.edges.size());
  const std::span<double> flows = keepsFlow ? std::span(flows_[label]) : std::span<double>();
  for (size_t e = 0; e < problem.edges.size(); ++e) {
    const LabelEdge& edge = problem.edges[e];
    const uint32_t f = nodeOf_[edge.f], g = nodeOf_[edge.g];
    const double earlierFlow = keepsFlow ? std::exchange(flows[e], 0) : 0;
    const bool isUncut = labels[edge.f] == labels[edge.g];
    if (f != kNoNode && g != kNoNode) {
      const double capacity = isUncut ? edge.cost : edge.cost / 2;
      if (capacity == 0) continue;
      const double flow = std::clamp(earlierFlow, -capacity, capacity);
      flow_.addEdge(f, g, capacity - flow, capacity + flow);
      gains_[f].add(isUncut ? -flow : capacity - flow);
      gains_[g].add(isUncut ? flow : capacity + flow);
      if (keepsFlow) flows[e] = capacity;
    } else if (f != kNoNode || g != kNoNode) {
      // The other face keeps its label.
      Gain& gain = gains_[f != kNoNode ? f : g];
      if (isUncut)
        gain.add(-edge.cost);
      else if (labels[f != kNoNode ? edge.g : edge.f] == label)
        gain.add(edge.cost);
    }
  }
  const bool hasGain = std::ranges::any_of(gains_, [](const Gain& gain) { return gain.value() > 0; });
  if (hasGain) {
    for (uint32_t node = 0; node < gains_.size(); ++node) flow_.addTerminal(node, gains_[node].value());
    static_cast<void>(flow_.solve(stopOnly, hasFlow ? MaxFlow::Start::NearMaximum : MaxFlow::Start::NoFlow));
  }
  // So far, `flows` has the capacities of the edges of the graph, and 0 for the others.
  size_t edgeCount = 0;
  for (double& flow : flows)
    if (flow > 0) flow -= flow_.residual(edgeCount++);
  if (!hasGain) return false;
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
