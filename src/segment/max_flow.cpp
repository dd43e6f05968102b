#include "segment/max_flow.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

/// Number of nodes of each smallest range, and number of ranges that are joined to a larger range.
constexpr size_t kNodesPerRange = 8192, kRangesPerRange = 8;
constexpr uint32_t kStepsPerPoll = 1024;
/// Bounds the rounding error of a sum of at most nine terms, divided by the sum of the magnitudes of the terms. Errors
/// of the terms themselves are not included.
constexpr double kMaxRoundingError = 0x1p-50;

}  // namespace

void MaxFlow::reset(uint32_t nodeCount) {
  nodes_.assign(nodeCount, Node());
  magnitudes_.assign(nodeCount, 0);
  arcs_.clear();
  queue_.resize(nodeCount);
  hasFlow_ = false;
  flow_ = 0;
}

void MaxFlow::addTerminal(uint32_t node, double capacity) {
  nodes_[node].terminal += capacity;
  magnitudes_[node] += std::abs(capacity);
}

void MaxFlow::addEdge(uint32_t a, uint32_t b, double capacity, double reverseCapacity, double flow) {
  const auto arc = static_cast<uint32_t>(arcs_.size());
  arcs_.push_back({b, nodes_[a].firstArc, capacity - flow});
  arcs_.push_back({a, nodes_[b].firstArc, reverseCapacity + flow});
  nodes_[a].firstArc = arc;
  nodes_[b].firstArc = arc + 1;
  if (flow == 0) return;
  // Capacities of terminals stand for the flow into and out of the edge. All cuts change by the same value.
  addTerminal(a, -flow);
  addTerminal(b, flow);
  hasFlow_ = true;
}

/// The search within a range of nodes, without the edges to other nodes.
class MaxFlow::Search {
 public:
  Search(MaxFlow& graph, uint32_t begin, uint32_t end)
      : nodes_(graph.nodes_.data()),
        arcs_(graph.arcs_.data()),
        queue_(&graph.queue_[begin]),
        begin_(begin),
        count_(end - begin) {}

  /// Before the search, routes flow along the trees of a forest, from leaves to roots. Most flow has a short path.
  void routeAlongForest();
  /// Every node with a terminal capacity becomes the root of a tree.
  void plant();
  /// Joins ranges of this size, which are already solved.
  void join(size_t partSize);
  /// Searches until the trees cannot grow, or until a stop is requested.
  void run(const std::stop_token& stop);

  [[nodiscard]] double flow() const { return flow_; }

 private:
  [[nodiscard]] bool contains(uint32_t node) const { return node - begin_ < count_; }
  void activate(uint32_t node);
  /// Grows the tree at an active node. Returns an arc between the trees of source and sink, or kNone.
  uint32_t grow(uint32_t node);
  void augment(uint32_t bridge);
  void adoptOrphans();
  void adopt(uint32_t orphan);
  void makeOrphan(uint32_t node);
  /// Arcs from the node to its terminal; kNone if an orphan is on this path.
  uint32_t distanceToTerminal(uint32_t node);
  /// The residual capacity between a node of `tree` and its child, through `arc` from node to child. In the tree of the
  /// source, the capacity is towards the child. In the tree of the sink, the capacity is from the child to the node.
  [[nodiscard]] double residualToChild(Tree tree, uint32_t arc) const {
    return arcs_[tree == Tree::Source ? arc : arc ^ 1].residual;
  }

  Node* nodes_;
  Arc* arcs_;
  uint32_t* queue_;  ///< Ring buffer of active nodes, with room for each node of the range.
  uint32_t begin_, count_;
  uint32_t queueBegin_ = 0, queueSize_ = 0;
  std::vector<uint32_t> orphans_;
  uint32_t time_ = 0;
  double flow_ = 0;
};

double MaxFlow::solve(const RunControl& stopOnly) {
  ASDFVK_CHECK_OP(arcs_.size(), <, size_t{kOrphan});
  bool hasSource = false;
  for (size_t node = 0; node < nodes_.size(); ++node) {
    double& terminal = nodes_[node].terminal;
    if (std::abs(terminal) <= kMaxRoundingError * magnitudes_[node]) terminal = 0;
    hasSource |= terminal > 0;
  }
  if (!hasSource) return 0;
  size_t partSize = 0;
  for (size_t size = kNodesPerRange;; partSize = size, size *= kRangesPerRange) {
    const size_t rangeCount = (nodes_.size() + size - 1) / size;
    std::vector<double> flows(rangeCount);
    forEachTask(rangeCount, [&](size_t range) {
      const size_t begin = range * size, end = std::min(nodes_.size(), begin + size);
      Search search(*this, static_cast<uint32_t>(begin), static_cast<uint32_t>(end));
      if (partSize == 0) {
        if (!hasFlow_) search.routeAlongForest();
        search.plant();
      } else {
        search.join(partSize);
      }
      search.run(stopOnly.stop);
      flows[range] = search.flow();
    });
    stopOnly.checkpoint(0);
    for (const double flow : flows) flow_ += flow;
    if (rangeCount <= 1) return flow_;
  }
}

void MaxFlow::Search::plant() {
  for (uint32_t node = begin_; node < begin_ + count_; ++node) {
    Node& n = nodes_[node];
    if (n.terminal == 0) continue;
    n.tree = n.terminal > 0 ? Tree::Source : Tree::Sink;
    n.parent = kTerminal;
    n.distance = 1;
    activate(node);
  }
}

void MaxFlow::Search::join(size_t partSize) {
  for (uint32_t node = begin_; node < begin_ + count_; ++node) {
    Node& n = nodes_[node];
    time_ = std::max(time_, n.checkedAt);
    if (n.tree == Tree::Free) continue;
    for (uint32_t arc = n.firstArc; arc != kNone; arc = arcs_[arc].next) {
      const uint32_t other = arcs_[arc].to;
      if (other / partSize == node / partSize || !contains(other)) continue;
      activate(node);
      break;
    }
  }
}

void MaxFlow::Search::run(const std::stop_token& stop) {
  for (uint32_t step = 0; queueSize_ > 0; ++step) {
    if (step % kStepsPerPoll == 0 && stop.stop_requested()) return;
    const uint32_t node = queue_[queueBegin_];
    const uint32_t bridge = nodes_[node].tree == Tree::Free ? kNone : grow(node);
    if (bridge == kNone) {
      nodes_[node].isActive = false;
      if (++queueBegin_ == count_) queueBegin_ = 0;
      --queueSize_;
    } else {
      ++time_;
      augment(bridge);
      adoptOrphans();
    }
  }
}

// Moves the terminal capacity of each node to its parent in the tree, up to the capacity of the edge. The value of a
// cut changes only by terminal capacities that cancel out.
void MaxFlow::Search::routeAlongForest() {
  constexpr size_t kMaxTreeSize = 512;  // Sizes from 64 to 8,000 are equally fast within the noise.
  size_t begin = 0, end = 0;
  for (uint32_t root = begin_; root < begin_ + count_; ++root) {
    if (nodes_[root].parent != kNone) continue;
    const size_t first = end;
    nodes_[root].parent = kTerminal;
    queue_[end++] = root;
    for (; begin < end; ++begin)
      for (uint32_t arc = nodes_[queue_[begin]].firstArc; arc != kNone && end - first < kMaxTreeSize;
           arc = arcs_[arc].next) {
        if (!contains(arcs_[arc].to)) continue;
        Node& child = nodes_[arcs_[arc].to];
        if (child.parent != kNone) continue;
        child.parent = arc ^ 1;
        queue_[end++] = arcs_[arc].to;
      }
  }
  while (end-- > 0) {
    Node& n = nodes_[queue_[end]];
    const uint32_t toParent = n.parent;
    n.parent = kNone;
    if (toParent == kTerminal) continue;
    double& parentTerminal = nodes_[arcs_[toParent].to].terminal;
    const bool isFromSource = n.terminal > 0;
    const uint32_t forward = isFromSource ? toParent : toParent ^ 1;
    const double amount = std::min(std::abs(n.terminal), arcs_[forward].residual);
    arcs_[forward].residual -= amount;
    arcs_[forward ^ 1].residual += amount;
    if ((parentTerminal > 0) != isFromSource) flow_ += std::min(amount, std::abs(parentTerminal));
    n.terminal -= isFromSource ? amount : -amount;
    parentTerminal += isFromSource ? amount : -amount;
  }
}

void MaxFlow::Search::activate(uint32_t node) {
  if (nodes_[node].isActive) return;
  nodes_[node].isActive = true;
  const uint32_t end = queueBegin_ + queueSize_++;
  queue_[end < count_ ? end : end - count_] = node;
}

uint32_t MaxFlow::Search::grow(uint32_t node) {
  const Node& n = nodes_[node];
  for (uint32_t arc = n.firstArc; arc != kNone; arc = arcs_[arc].next) {
    const uint32_t other = arcs_[arc].to;
    if (!contains(other) || !(residualToChild(n.tree, arc) > 0)) continue;
    Node& o = nodes_[other];
    if (o.tree == Tree::Free) {
      o.tree = n.tree;
      o.parent = arc ^ 1;
      o.checkedAt = n.checkedAt;
      o.distance = n.distance + 1;
      activate(other);
    } else if (o.tree != n.tree) {
      return n.tree == Tree::Source ? arc : arc ^ 1;
    } else if (o.checkedAt <= n.checkedAt && o.distance > n.distance) {
      // This path to the terminal is shorter, which keeps augmenting paths short.
      o.parent = arc ^ 1;
      o.checkedAt = n.checkedAt;
      o.distance = n.distance + 1;
    }
  }
  return kNone;
}

void MaxFlow::Search::makeOrphan(uint32_t node) {
  nodes_[node].parent = kOrphan;
  orphans_.push_back(node);
}

void MaxFlow::Search::augment(uint32_t bridge) {
  const uint32_t ends[] = {arcs_[bridge ^ 1].to, arcs_[bridge].to};
  double amount = arcs_[bridge].residual;
  for (const uint32_t end : ends) {
    uint32_t node = end;
    for (uint32_t arc; (arc = nodes_[node].parent) != kTerminal; node = arcs_[arc].to)
      amount = std::min(amount, residualToChild(nodes_[node].tree, arc ^ 1));
    amount = std::min(amount, std::abs(nodes_[node].terminal));
  }
  arcs_[bridge].residual -= amount;
  arcs_[bridge ^ 1].residual += amount;
  for (const uint32_t end : ends) {
    uint32_t node = end;
    const bool isSourceTree = nodes_[end].tree == Tree::Source;
    for (uint32_t arc; (arc = nodes_[node].parent) != kTerminal;) {
      const uint32_t forward = isSourceTree ? arc ^ 1 : arc;
      arcs_[forward].residual -= amount;
      arcs_[forward ^ 1].residual += amount;
      const uint32_t child = node;
      node = arcs_[arc].to;
      if (arcs_[forward].residual == 0) makeOrphan(child);
    }
    nodes_[node].terminal -= isSourceTree ? amount : -amount;
    if (nodes_[node].terminal == 0) makeOrphan(node);
  }
  flow_ += amount;
}

void MaxFlow::Search::adoptOrphans() {
  for (size_t i = 0; i < orphans_.size(); ++i) adopt(orphans_[i]);
  orphans_.clear();
}

uint32_t MaxFlow::Search::distanceToTerminal(uint32_t node) {
  uint32_t distance = 0, n = node;
  for (;; n = arcs_[nodes_[n].parent].to) {
    if (nodes_[n].checkedAt == time_) {
      distance += nodes_[n].distance;
      break;
    }
    if (nodes_[n].parent == kOrphan || nodes_[n].parent == kNone) return kNone;
    ++distance;
    if (nodes_[n].parent == kTerminal) {
      nodes_[n].checkedAt = time_;
      nodes_[n].distance = 1;
      break;
    }
  }
  uint32_t left = distance;
  for (n = node; nodes_[n].checkedAt != time_; n = arcs_[nodes_[n].parent].to) {
    nodes_[n].checkedAt = time_;
    nodes_[n].distance = left--;
  }
  return distance;
}

void MaxFlow::Search::adopt(uint32_t orphan) {
  Node& n = nodes_[orphan];
  uint32_t best = kNone, bestDistance = kNone;
  for (uint32_t arc = n.firstArc; arc != kNone; arc = arcs_[arc].next) {
    const uint32_t other = arcs_[arc].to;
    if (!contains(other) || nodes_[other].tree != n.tree || !(residualToChild(n.tree, arc ^ 1) > 0)) continue;
    const uint32_t distance = distanceToTerminal(other);
    if (distance < bestDistance) {
      bestDistance = distance;
      best = arc;
    }
  }
  if (best != kNone) {
    n.parent = best;
    n.checkedAt = time_;
    n.distance = bestDistance + 1;
    return;
  }
  for (uint32_t arc = n.firstArc; arc != kNone; arc = arcs_[arc].next) {
    const uint32_t other = arcs_[arc].to;
    if (!contains(other) || nodes_[other].tree != n.tree) continue;
    if (residualToChild(n.tree, arc ^ 1) > 0) activate(other);
    if (nodes_[other].parent == (arc ^ 1)) makeOrphan(other);
  }
  n.tree = Tree::Free;
  n.parent = kNone;
}

}  // namespace asdfvk
