#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "asdf_vk/run_control.h"

namespace asdfvk {

/// Maximum flow and minimum cut between two terminals, source and sink: Y. Boykov, V. Kolmogorov: An Experimental
/// Comparison of Min-Cut/Max-Flow Algorithms for Energy Minimization in Vision, PAMI 2004. Two search trees grow from
/// the terminals. Flow is augmented where the trees touch. A subtree that loses its parent gets another parent in the
/// same tree, preferably the one nearest to the terminal. If there is no other parent, the nodes of the subtree become
/// free. Before the search, flow is routed along the trees of a forest, which halves the time of graphs of meshes. If
/// the flow of a similar problem is known, the search begins with this flow instead: P. Kohli, P. Torr: Dynamic Graph
/// Cuts for Efficient Inference in Markov Random Fields, PAMI 2007.
///
/// Ranges of consecutive nodes are solved first, in parallel and without the edges between ranges. Then unions of
/// ranges are solved repeatedly, beginning with the trees of the joined ranges (J. Liu, J. Sun: Parallel Graph-cuts by
/// Adaptive Bottom-up Merging, CVPR 2010). A first range fits into a cache. Neighbouring nodes should have near
/// numbers.
///
/// Usage: call reset(), add capacities, call solve(), read the sides. For further problems of at most the same size,
/// the object allocates memory for lists of orphans only. The result does not depend on the number of threads. Memory:
/// 36 bytes per node and 32 bytes per edge.
class MaxFlow {
 public:
  void reset(uint32_t nodeCount);

  /// Adds a finite capacity from the source to the node. A negative number adds the capacity -capacity from the node to
  /// the sink. Capacities of one node to both terminals cancel out: solve() does not count the flow through this node
  /// alone. The flows of addEdge() are terms of the same sum. If the sum is at most 2^-50 of the magnitudes of its
  /// terms, solve() sets it to 0.
  void addTerminal(uint32_t node, double capacity);

  /// Adds an edge with a finite capacity of at least 0 in each direction. flow: an initial flow from a to b,
  /// between -reverseCapacity and capacity. The initial flows into a node and out of it need not be equal. If an edge
  /// has an initial flow, no forest is used. Precondition: a != b.
  void addEdge(uint32_t a, uint32_t b, double capacity, double reverseCapacity, double flow = 0);

  /// Returns the value of the maximum flow; 0 for an empty graph. If edges were added with a flow, returns only the
  /// flow that the search adds. Throws Error{Cancelled} if a node has a capacity from the source. Precondition: called
  /// once after each reset().
  double solve(const RunControl& stopOnly = {});

  /// The residual capacity from a to b: the capacity minus the flow. edge: number of earlier calls of addEdge() since
  /// reset().
  [[nodiscard]] double residual(size_t edge) const { return arcs_[2 * edge].residual; }

  /// Whether the node is on the side of the source: whether it is reachable from the source in the residual graph. No
  /// other minimum cut has fewer nodes on the side of the source.
  [[nodiscard]] bool isSource(uint32_t node) const { return nodes_[node].tree == Tree::Source; }

 private:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  static constexpr uint32_t kTerminal = kNone - 1;  ///< Value of Node::parent for a root.
  static constexpr uint32_t kOrphan = kNone - 2;

  enum class Tree : uint8_t { Free, Source, Sink };

  struct Node {
    uint32_t firstArc = kNone;
    uint32_t parent = kNone;     ///< Arc to the parent, kTerminal, kOrphan, or kNone for a free node.
    uint32_t checkedAt = 0;      ///< Time at which `distance` was valid.
    uint32_t distance : 29 = 0;  ///< Number of arcs to the terminal when `checkedAt` was set.
    Tree tree : 2 = Tree::Free;
    bool isActive : 1 = false;  ///< Whether the node is in the queue.
    /// Positive: residual capacity from the source. Negative: minus the residual capacity to the sink.
    double terminal = 0;
  };

  /// Arc 2 e is edge e from a to b; arc 2 e + 1 is the reverse.
  struct Arc {
    uint32_t to;
    uint32_t next;  ///< Next arc of the same node.
    double residual;
  };

  class Search;

  std::vector<Node> nodes_;
  std::vector<double> magnitudes_;  ///< Per node: the sum of the magnitudes of the terms of Node::terminal.
  std::vector<Arc> arcs_;
  std::vector<uint32_t> queue_;  ///< Has room for each node.
  bool hasFlow_ = false;         ///< Whether an edge was added with a flow.
  double flow_ = 0;
};

}  // namespace asdfvk
