#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/prefetch.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// Orders seeds by their triangles in the hierarchy, because neighbouring cones traverse the same nodes.
class SeedOrder {
 public:
  explicit SeedOrder(const TraceScene& scene);

  /// A permutation of the indices into seedFaces. Equal seeds keep their order.
  [[nodiscard]] std::vector<uint32_t> of(std::span<const uint32_t> seedFaces) const;

  /// Index of the face's representative in the hierarchy; kNoFace if the hierarchy lacks it.
  [[nodiscard]] uint32_t primitiveOf(uint32_t face) const { return primitiveOfFace_[representatives_[face]]; }

  /// Prefetches the memory that primitiveOf() reads.
  void prefetch(uint32_t face) const {
    prefetchMemory(&representatives_[face]);
    prefetchMemory(&primitiveOfFace_[face]);
  }

 private:
  std::span<const uint32_t> representatives_;
  std::vector<uint32_t> primitiveOfFace_;  // #F
};

/// A permutation of the indices into `starts` that orders them along a space-filling curve (Morton 1966), because
/// neighbouring cones traverse the same nodes. An origin outside of the normalised box has the place of
/// the nearest point of the box.
[[nodiscard]] std::vector<uint32_t> spatialOrder(std::span<const ConeStart> starts);

}  // namespace asdfvk
