#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"

namespace asdfvk {

/// Faces around a face by ascending distance along the arcs of the dual graph (Dijkstra's algorithm), one ball after
/// another with the memory of the largest. The graph and the lengths must outlive it.
class SurfaceBall {
 public:
  /// arcLengths: aligned with graph.neighbours, positive.
  SurfaceBall(const DualGraph& graph, std::span<const float> arcLengths);

  struct Member {
    float distance = 0;  ///< From the centre.
    uint32_t face = 0;
  };

  /// Starts over around `centre`, which is the first member.
  void startAt(uint32_t centre);
  /// False when the centre's component is exhausted, else the next nearest face; equals in no particular, but always
  /// the same order.
  [[nodiscard]] bool next(Member& member);

 private:
  const DualGraph& graph_;
  std::span<const float> arcLengths_;
  std::vector<float> distances_;   ///< #F; infinite but for the touched faces.
  std::vector<uint32_t> touched_;  ///< By the ball at work.
  std::vector<Member> heap_;
};

}  // namespace asdfvk
