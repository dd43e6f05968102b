#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

namespace asdfvk::test {

/// Maximum flow by Dinic's algorithm, in the plainest form: the twin of MaxFlow.
class PlainMaxFlow {
 public:
  explicit PlainMaxFlow(uint32_t nodeCount) : rows_(nodeCount + 2), source_(nodeCount), sink_(nodeCount + 1) {}

  void addTerminal(uint32_t node, double fromSource, double toSink) {
    addEdge(source_, node, fromSource, 0);
    addEdge(node, sink_, toSink, 0);
  }
  void addEdge(uint32_t a, uint32_t b, double capacity, double reverseCapacity) {
    rows_[a].push_back({b, static_cast<uint32_t>(rows_[b].size()), capacity});
    rows_[b].push_back({a, static_cast<uint32_t>(rows_[a].size()) - 1, reverseCapacity});
  }

  double solve() {
    double flow = 0;
    while (findLevels()) {
      next_.assign(rows_.size(), 0);
      while (const double pushed = push(source_, std::numeric_limits<double>::infinity())) flow += pushed;
    }
    return flow;
  }

  /// After solve(): reachable from the source.
  [[nodiscard]] bool isSource(uint32_t node) const { return level_[node] != kUnreached; }

 private:
  struct Arc {
    uint32_t to, reverse;
    double residual;
  };
  static constexpr uint32_t kUnreached = ~0u;

  bool findLevels() {
    level_.assign(rows_.size(), kUnreached);
    level_[source_] = 0;
    for (std::queue<uint32_t> queue({source_}); !queue.empty(); queue.pop())
      for (const Arc& arc : rows_[queue.front()])
        if (arc.residual > 0 && level_[arc.to] == kUnreached) {
          level_[arc.to] = level_[queue.front()] + 1;
          queue.push(arc.to);
        }
    return level_[sink_] != kUnreached;
  }

  double push(uint32_t node, double limit) {
    if (node == sink_) return limit;
    for (uint32_t& i = next_[node]; i < rows_[node].size(); ++i) {
      Arc& arc = rows_[node][i];
      if (!(arc.residual > 0) || level_[arc.to] != level_[node] + 1) continue;
      if (const double pushed = push(arc.to, std::min(limit, arc.residual)); pushed > 0) {
        arc.residual -= pushed;
        rows_[arc.to][arc.reverse].residual += pushed;
        return pushed;
      }
    }
    return 0;
  }

  std::vector<std::vector<Arc>> rows_;
  uint32_t source_, sink_;
  std::vector<uint32_t> level_, next_;
};

}  // namespace asdfvk::test
