#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "segment/max_flow.h"

namespace asdfvk {

struct LabelEdge {
  uint32_t f, g;  ///< Different faces.
  double cost;    ///< Finite and at least 0; added to the energy if the labels of f and g differ.
};

/// The energy of a labelling is the sum of the data costs of the faces and of the costs of cut edges (Potts model).
struct LabelProblem {
  uint32_t labelCount = 0;
  std::span<const double> dataCosts;  ///< #F x labelCount, by face; infinite for a forbidden label, never NaN.
  std::span<const LabelEdge> edges;   ///< Several edges between two faces add up.

  /// Replaces dataCosts if few labels per face are allowed. Face f may have the labels of choices[firstChoices[f]] to
  /// choices[firstChoices[f + 1] - 1].
  struct Choice {
    uint32_t label;
    double cost;
  };
  std::span<const uint32_t> firstChoices;  ///< #F+1, or empty.
  std::span<const Choice> choices;

  [[nodiscard]] uint32_t faceCount() const {
    return static_cast<uint32_t>(firstChoices.empty() ? dataCosts.size() / labelCount : firstChoices.size() - 1);
  }
  [[nodiscard]] double dataCost(uint32_t face, uint32_t label) const {
    if (firstChoices.empty()) return dataCosts[size_t{face} * labelCount + label];
    for (uint32_t i = firstChoices[face]; i < firstChoices[face + 1]; ++i)
      if (choices[i].label == label) return choices[i].cost;
    return std::numeric_limits<double>::infinity();
  }
};

/// labels: #F, below problem.labelCount. Infinite if a face has a forbidden label.
[[nodiscard]] double labelEnergy(const LabelProblem& problem, std::span<const uint32_t> labels);

/// Alpha expansion: Y. Boykov, O. Veksler, R. Zabih: Fast Approximate Energy Minimization via Graph Cuts, PAMI 2001.
/// The expansion of a label gives the label to the set of faces that lowers the energy most. If several sets are
/// equally good, the smallest of them gets the label. The graph has a node per face that can change, and no auxiliary
/// nodes: V. Kolmogorov, R. Zabih: What Energy Functions Can Be Minimized via Graph Cuts?, PAMI 2004. A face for which
/// the label is forbidden has no node. The expansion of one of the first eight labels begins with the flow of the last
/// expansion of this label. Deterministic. An object reuses its memory.
class AlphaExpansion {
 public:
  struct Limits {
    uint32_t expandedLabelCount = std::numeric_limits<uint32_t>::max();
    uint32_t maxRoundCount = std::numeric_limits<uint32_t>::max();
  };

  /// Expands the labels in order, in rounds, until a round changes nothing. An expansion that lowers the energy by at
  /// most 1e-10 of the energy is discarded, so that rounding cannot cause an endless loop. labels: #F, below
  /// problem.labelCount and allowed; improved in place. Returns the energy of the improved labels. Throws
  /// Error{Cancelled}.
  double minimize(const LabelProblem& problem, std::span<uint32_t> labels, const Limits& limits,
                  const RunControl& control = {});
  double minimize(const LabelProblem& problem, std::span<uint32_t> labels) { return minimize(problem, labels, {}); }

 private:
  /// Writes the labels after the best expansion to expanded_. Returns whether a face changes.
  bool expand(const LabelProblem& problem, std::span<const uint32_t> labels, uint32_t label,
              const RunControl& stopOnly);

  MaxFlow flow_;
  std::vector<uint32_t> nodeOf_;  ///< #F
  std::vector<uint32_t> expanded_;
  /// For the first labels, if expansions may be repeated: for each edge, the flow from f to g after the last expansion
  /// of the label.
  std::vector<std::vector<double>> flows_;
};

}  // namespace asdfvk
