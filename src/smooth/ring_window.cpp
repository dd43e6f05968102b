#include "smooth/ring_window.h"

#include <algorithm>

#include "core/check.h"

namespace asdfvk {

void RingWindow::gather(const DualGraph& graph, uint32_t face, uint32_t ringCount) {
  ASDFVK_CHECK_OP(ringCount, >=, 1u);
  ASDFVK_CHECK_OP(ringCount, <=, kMaxBilateralWindow);
  ringCount_ = ringCount;
  faces_[0] = face;
  ringEnds_[0] = 1;
  uint32_t count = 1, arcsLeft = kMaxWindowArcCount;
  for (uint32_t ring = 1; ring <= ringCount; ++ring) {
    // A neighbour of the ring before lies in that ring, next to it inwards, or here.
    const uint32_t known = ring < 2 ? 0 : ringBegin(ring - 2);
    const uint32_t parentEnd = count;
    for (uint32_t parent = ringBegin(ring - 1); parent < parentEnd; ++parent)
      for (uint32_t neighbour : graph.neighboursOf(faces_[parent])) {
        if (arcsLeft == 0 || count == kMaxWindowFaceCount) break;
        --arcsLeft;
        const auto end = faces_.begin() + count;
        if (std::find(faces_.begin() + known, end, neighbour) == end) faces_[count++] = neighbour;
      }
    ringEnds_[ring] = count;
  }
}

}  // namespace asdfvk
