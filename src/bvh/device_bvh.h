#pragma once

#include <cstddef>
#include <span>

#include "bvh/bvh.h"
#include "core/unset_vector.h"
#include "mesh/face_geometry.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// Margin of the boxes on a device, in normalised units. The triangle test in float32 has an error of a few units of
/// 2^-24 times coordinates up to 3.5. A ray must enter each box that contains a triangle that it hits.
inline constexpr float kDeviceBoxMargin = 0x1p-20f;

enum class BvhLayout {
  Binary,  ///< DeviceBvhNode: two children, boxes in float32.
  Wide,    ///< DeviceWideNode: eight children, boxes in bytes.
};

/// The hierarchy in the layout of shared/bvh_layout.h. A traversal stack needs `depth` entries.
struct DeviceBvh {
  /// Only the array of the layout is filled; both are empty for an empty Bvh. Binary nodes are the inner nodes of the
  /// Bvh, in the same order.
  UnsetVector<DeviceBvhNode> nodes;
  UnsetVector<DeviceWideNode> wideNodes;
  UnsetVector<DeviceTriangle> triangles;  ///< One per primitive; corners rounded to nearest.
  uint32_t depth = 0;

  [[nodiscard]] std::span<const std::byte> nodeBytes() const {
    return nodes.empty() ? std::as_bytes(std::span(wideNodes)) : std::as_bytes(std::span(nodes));
  }
};

inline constexpr size_t kDeviceBlockByteCount = 16;  ///< A texel, or a uvec4 of a storage buffer.

/// Upper bound of the blocks of the largest array of encodeDeviceBvh(). Leaves have at most kMaxWideLeafTriangleCount
/// triangles.
[[nodiscard]] uint64_t maxBlockCount(const Bvh& bvh, BvhLayout layout);

/// Binary: a Bvh whose root is a leaf becomes one node with that leaf as both children, the right one with a box that
/// no ray enters. Throws Error{DeviceLimit} for more triangles than a reference can index.
[[nodiscard]] DeviceBvh encodeDeviceBvh(const Bvh& bvh, const TriangleMesh& mesh, const FaceGeometry& geometry,
                                        BvhLayout layout = BvhLayout::Binary);

}  // namespace asdfvk
