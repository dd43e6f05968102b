#pragma once

#include <cstdint>

#include "bvh/bvh.h"
#include "core/unset_vector.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// Wide nodes in the layout of shared/bvh_layout.h. Order of a subtree: the root; its children; all nodes below the
/// first child; all nodes below the second child; and so on.
struct WideBvh {
  UnsetVector<DeviceWideNode> nodes;
  UnsetVector<uint32_t> primitiveFaces;  ///< See Bvh. A subtree has the range of primitives that it has in the Bvh.
  uint32_t depth = 0;                    ///< Levels of nodes below the root, at most kMaxBvhDepth.
};

/// Empty for an empty Bvh. Parallel, with the same result for any thread count.
[[nodiscard]] WideBvh encodeWideBvh(const Bvh& bvh);

}  // namespace asdfvk
