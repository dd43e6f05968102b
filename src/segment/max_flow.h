#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace asdfvk {

/// Maximum flow and minimum cut between two terminals, source and sink, by the method of Y. Boykov and V. Kolmogorov:
/// An Experimental Comparison of Min-Cut/Max-Flow Algorithms for Energy Minimization in Vision, PAMI 2004. Two search
/// trees grow from the terminals; where they touch, flow is augmented; cut-off subtrees are adopted by other parents
/// of their tree, the nearest to the terminal first, or become free. Before the search, flow is routed along the trees
/// of a forest, which halves the time of graphs of meshes.
///
/// Ranges of consecutive nodes are solved first, in parallel and without the edges between them, then ranges of ranges,
/// which continue from the trees of their parts: J. Liu, J. Sun: Parallel Graph-cuts by Adaptive Bottom-up Merging,
/// CVPR 2010. A range fits a cache. Nodes near each other should have near numbers.
///
/// Usage: reset(), then capacities, then solve(), then the sides. The arrays are reused: an object that has solved a
/// problem allocates nothing for another that is no larger, but for the lists of orphans. The result does not depend on
/// the number of threads. 36 bytes per node and 32 per edge.
class MaxFlow {
 public:
  /// Nodes without capacities.
  void reset(uint32_t nodeCount);

  /// Adds `capacity` from the source to the node; negative: -capacity from the node to the sink. Capacities of one node
  /// to both terminals cancel out: the flow through the node alone is not part of the value of solve(). Finite.
  void addTerminal(uint32_t node, double capacity);

  /// Adds an edge with a capacity in both directions, finite and not negative. Precondition: a != b.
  void addEdge(uint32_t a, uint32_t b, double capacity, double reverseCapacity);

  /// The value of the maximum flow; an empty graph has 0. Once per reset().
  double solve();

  /// Whether the node is on the source's side of the minimum cut: reachable from the source in the residual graph. Of
  /// all minimum cuts this one has the fewest nodes on that side; nodes between the cuts are not source.
  [[nodiscard]] bool isSource(uint32_t node) const { return nodes_[node].tree == Tree::Source; }

  [[nodiscard]] uint32_t nodeCount() const { return static_cast<uint32_t>(nodes_.size()); }

 private:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  static constexpr uint32_t kTerminal = kNone - 1;  ///< Parent of a root.
  static constexpr uint32_t kOrphan = kNone - 2;

  enum class Tree : uint8_t { Free, Source, Sink };

  struct Node {
    uint32_t firstArc = kNone;
    uint32_t parent = kNone;     ///< Arc to the parent, kTerminal, kOrphan, or kNone for a free node.
    uint32_t checkedAt = 0;      ///< Time at which `distance` was valid.
    uint32_t distance : 29 = 0;  ///< Arcs to the terminal, as far as known.
    Tree tree : 2 = Tree::Free;
    bool isActive : 1 = false;  ///< Whether the node is in the queue.
    double terminal = 0;        ///< Positive: residual capacity from the source. Negative: minus that to the sink.
  };

  /// Arc 2 e is edge e from a to b, arc 2 e + 1 its reverse.
  struct Arc {
    uint32_t to;
    uint32_t next;  ///< Next arc of the same node.
    double residual;
  };

  class Search;

  std::vector<Node> nodes_;
  std::vector<Arc> arcs_;
  std::vector<uint32_t> queue_;  ///< A place for each node.
  double flow_ = 0;
};

}  // namespace asdfvk
