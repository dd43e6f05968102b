#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/cone_tracer.h"

namespace asdfvk {

/// Neighbouring cones walk the same nodes: seeds are best visited in the order of their triangles in the hierarchy.
class SeedOrder {
 public:
  explicit SeedOrder(const TraceScene& scene);

  /// A permutation of the indices into seedFaces; equal seeds keep their order.
  [[nodiscard]] std::vector<uint32_t> of(std::span<const uint32_t> seedFaces) const;

  /// The triangle slot of the face or of the one that stands for it; kNoFace where that is not in the hierarchy.
  [[nodiscard]] uint32_t slotOf(uint32_t face) const { return slotOfFace_[representatives_[face]]; }

  /// Begins to fetch what slotOf() reads.
  void prefetch(uint32_t face) const {
    __builtin_prefetch(&representatives_[face]);
    __builtin_prefetch(&slotOfFace_[face]);
  }

 private:
  std::span<const uint32_t> representatives_;
  std::vector<uint32_t> slotOfFace_;  // #F
};

}  // namespace asdfvk
