#pragma once

#include <vector>

#include "bvh/bvh.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// The hierarchy in the layout of shared/bvh_layout.h. Its nodes are the inner nodes of the Bvh, in the Bvh's order. A
/// walk needs a stack of Bvh::depth entries.
struct DeviceBvh {
  std::vector<DeviceBvhNode> nodes;       ///< Empty for an empty Bvh: then there is nothing to trace against.
  std::vector<DeviceTriangle> triangles;  ///< One per slot; corners rounded to nearest.
};

/// A Bvh whose root is a leaf becomes one node with that leaf on its left. Its right child has the inverted box
/// (min 2, max -2), which no ray hits by a test that orders the slabs by the ray's sign. Other tests may enter it: it
/// is a leaf of slot 0, whose triangle is then met twice, which changes no nearest hit.
[[nodiscard]] DeviceBvh encodeDeviceBvh(const Bvh& bvh, const Mesh& mesh);

}  // namespace asdfvk
