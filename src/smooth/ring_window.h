#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mesh/dual_graph.h"

namespace asdfvk {

inline constexpr uint32_t kMaxBilateralWindow = 4;
/// Four rings around a face have at most 1 + 3 + 6 + 12 + 24 = 46 faces, found along 66 arcs, if every edge joins two
/// faces. Windows are cut off at these limits, so that their cost is bounded where more faces meet at an edge.
inline constexpr uint32_t kMaxWindowFaceCount = 64;
inline constexpr uint32_t kMaxWindowArcCount = 96;

/// The faces within so many rings of the dual graph around a face, each once: the face itself (ring 0), then ring by
/// ring.
class RingWindow {
 public:
  /// ringCount: 1 to kMaxBilateralWindow. Of more than kMaxWindowFaceCount faces, and of what lies beyond the first
  /// kMaxWindowArcCount arcs, the rest is left out; both take an edge of more than two faces.
  void gather(const DualGraph& graph, uint32_t face, uint32_t ringCount);

  /// Those at distance 0 .. ringCount; valid until the next gather().
  [[nodiscard]] std::span<const uint32_t> faces() const { return {faces_.data(), ringEnds_[ringCount_]}; }
  /// Those at distance `ring`.
  [[nodiscard]] std::span<const uint32_t> ring(uint32_t ring) const {
    return faces().subspan(ringBegin(ring), ringEnds_[ring] - ringBegin(ring));
  }
  [[nodiscard]] uint32_t ringCount() const { return ringCount_; }

 private:
  [[nodiscard]] uint32_t ringBegin(uint32_t ring) const { return ring == 0 ? 0 : ringEnds_[ring - 1]; }

  std::array<uint32_t, kMaxWindowFaceCount> faces_;
  std::array<uint32_t, kMaxBilateralWindow + 1> ringEnds_{};
  uint32_t ringCount_ = 0;
};

}  // namespace asdfvk
