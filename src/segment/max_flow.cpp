#include "segment/max_flow.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace asdfvk {

void MaxFlow::reset(uint32_t nodeCount) {
  nodes_.assign(nodeCount, Node());
  arcs_.clear();
  orphans_.clear();
  queue_.resize(nodeCount);
  queueBegin_ = queueSize_ = 0;
  time_ = 0;
  flow_ = 0;
}

void MaxFlow::addTerminal(uint32_t node, double capacity) { nodes_[node].terminal += capacity; }

void MaxFlow::addEdge(uint32_t a, uint32_t b, double capacity, double reverseCapacity) {
  const auto arc = static_cast<uint32_t>(arcs_.size());
  arcs_.push_back({b, nodes_[a].firstArc, capacity});
  arcs_.push_back({a, nodes_[b].firstArc, reverseCapacity});
  nodes_[a].firstArc = arc;
  nodes_[b].firstArc = arc + 1;
}

double MaxFlow::solve() {
  ASDFVK_CHECK_OP(arcs_.size(), <, size_t{kOrphan});
  routeAlongForest();
  for (uint32_t node = 0; node < nodeCount(); ++node) {
    Node& n = nodes_[node];
    if (n.terminal == 0) continue;
    n.tree = n.terminal > 0 ? Tree::Source : Tree::Sink;
    n.parent = kTerminal;
    n.distance = 1;
    activate(node);
  }
  while (queueSize_ > 0) {
    const uint32_t node = queue_[queueBegin_];
    const uint32_t bridge = nodes_[node].tree == Tree::Free ? kNone : grow(node);
    if (bridge == kNone) {
      nodes_[node].isActive = false;
      if (++queueBegin_ == queue_.size()) queueBegin_ = 0;
      --queueSize_;
    } else {
      ++time_;
      augment(bridge);
      adoptOrphans();
    }
  }
  return flow_;
}

// Moves what a node has from the source, or to the sink, to its parent in the tree as far as the edge carries it. That
// changes the value of no cut but by what cancels out.
void MaxFlow::routeAlongForest() {
  constexpr size_t kMaxTreeSize = 512;  // 64 to 8,000 are as fast within the noise.
  size_t begin = 0, end = 0;
  for (uint32_t root = 0; root < nodeCount(); ++root) {
    if (nodes_[root].parent != kNone) continue;
    const size_t first = end;
    nodes_[root].parent = kTerminal;
    queue_[end++] = root;
    for (; begin < end; ++begin)
      for (uint32_t arc = nodes_[queue_[begin]].firstArc; arc != kNone && end - first < kMaxTreeSize;
           arc = arcs_[arc].next) {
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

void MaxFlow::activate(uint32_t node) {
  if (nodes_[node].isActive) return;
  nodes_[node].isActive = true;
  const size_t end = queueBegin_ + queueSize_++;
  queue_[end < queue_.size() ? end : end - queue_.size()] = node;
}

uint32_t MaxFlow::grow(uint32_t node) {
  const Node& n = nodes_[node];
  for (uint32_t arc = n.firstArc; arc != kNone; arc = arcs_[arc].next) {
    if (!(residualToChild(n.tree, arc) > 0)) continue;
    const uint32_t other = arcs_[arc].to;
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
      // A shorter way to the terminal, which keeps augmenting paths short.
      o.parent = arc ^ 1;
      o.checkedAt = n.checkedAt;
      o.distance = n.distance + 1;
    }
  }
  return kNone;
}

void MaxFlow::makeOrphan(uint32_t node) {
  nodes_[node].parent = kOrphan;
  orphans_.push_back(node);
}

void MaxFlow::augment(uint32_t bridge) {
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

void MaxFlow::adoptOrphans() {
  for (size_t i = 0; i < orphans_.size(); ++i) adopt(orphans_[i]);
  orphans_.clear();
}

uint32_t MaxFlow::distanceToTerminal(uint32_t node) {
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

void MaxFlow::adopt(uint32_t orphan) {
  Node& n = nodes_[orphan];
  uint32_t best = kNone, bestDistance = kNone;
  for (uint32_t arc = n.firstArc; arc != kNone; arc = arcs_[arc].next) {
    const uint32_t other = arcs_[arc].to;
    if (nodes_[other].tree != n.tree || !(residualToChild(n.tree, arc ^ 1) > 0)) continue;
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
    if (nodes_[other].tree != n.tree) continue;
    if (residualToChild(n.tree, arc ^ 1) > 0) activate(other);
    if (nodes_[other].parent == (arc ^ 1)) makeOrphan(other);
  }
  n.tree = Tree::Free;
  n.parent = kNone;
}

}  // namespace asdfvk
