#pragma once

#include <cstdint>

#include "bvh/bvh.h"
#include "core/unset_vector.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// The wide nodes of shared/bvh_layout.h, children behind their parents: those of a node, then all below the first,
/// then all below the second, and so on.
struct WideBvh {
  UnsetVector<DeviceWideNode> nodes;
  UnsetVector<uint32_t> slotFaces;  ///< As in Bvh; a subtree has the same range of slots as there.
  uint32_t depth = 0;               ///< Levels below the root: a walk needs a stack of so many entries.
};

/// Collapses `bvh`, which has at least one node, by WideCollapse. Leaves of more than kMaxWideLeafTriangleCount are
/// halved, and the halves keep their box. Parallel, with the same result for any thread count.
[[nodiscard]] WideBvh encodeWideBvh(const Bvh& bvh);

}  // namespace asdfvk
