#pragma once

#include <cstddef>
#include <cstdint>

#include "bvh/bvh.h"

namespace asdfvk {

/// What a hierarchy is like; all zero for an empty one.
struct BvhStatistics {
  size_t nodeCount = 0;  ///< Leaves included.
  size_t leafCount = 0;
  uint32_t depth = 0;  ///< Levels below the root, found by walking; see Bvh::depth.
  /// Expected cost of a random line that hits the root's box, in triangle tests, when a node costs kNodeCost. Smaller
  /// is better; 97,000 faces of a smooth closed shape have about 20 to 30.
  double sahCost = 0;
};

[[nodiscard]] BvhStatistics computeBvhStatistics(const Bvh& bvh);

}  // namespace asdfvk
