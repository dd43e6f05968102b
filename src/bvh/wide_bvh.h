#pragma once

#include <vector>

#include "bvh/bvh.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// The wide nodes of shared/bvh_layout.h, children behind their parents: those of a node, then all below the first,
/// then all below the second, and so on.
struct WideBvh {
  std::vector<DeviceWideNode> nodes;
  std::vector<DeviceTriangle> triangles;  ///< A subtree has the same range of slots as in the binary hierarchy.
  uint32_t depth = 0;                     ///< Levels below the root: a walk needs a stack of so many entries.
};

/// Collapses `bvh`, which has at least one node, by WideCollapse. `triangles` are in the slots of `bvh`, leaves of more
/// than kMaxWideLeafTriangleCount of them are split. Parallel, with the same result for any thread count.
[[nodiscard]] WideBvh encodeWideBvh(const Bvh& bvh, const std::vector<DeviceTriangle>& triangles);

}  // namespace asdfvk
