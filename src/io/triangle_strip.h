#pragma once

#include <array>
#include <cstdint>

#include "io/input_faces.h"

namespace asdfvk {

/// Turns a run of vertex indices into triangles: each index after the second makes one with the two before it, every
/// other one turned round so that all wind as the first. Triangles that name a vertex twice are no faces: they only
/// stitch strips together, and are passed over.
class TriangleStrip {
 public:
  explicit TriangleStrip(InputFaces& faces) : faces_(faces) {}

  /// The next index begins a new strip.
  void restart() { length_ = 0; }

  void add(uint32_t vertex) {
    if (length_ >= 2 && before_ != last_ && last_ != vertex && vertex != before_) {
      const bool isTurned = length_ % 2 == 1;
      const std::array<uint32_t, 3> corners = {isTurned ? last_ : before_, isTurned ? before_ : last_, vertex};
      faces_.add(corners);
    }
    before_ = last_;
    last_ = vertex;
    ++length_;
  }

 private:
  InputFaces& faces_;
  uint64_t length_ = 0;
  uint32_t before_ = 0;
  uint32_t last_ = 0;
};

}  // namespace asdfvk
