#pragma once

#include <cstddef>
#include <span>

#include "bvh/bvh.h"
#include "core/unset_vector.h"
#include "mesh/face_geometry.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// Boxes grow by this on a device, in normalised units: its triangle test in float32 is off by a few units of 2^-24 of
/// coordinates up to 3.5, and no box may be missed whose triangle is hit.
inline constexpr float kDeviceBoxMargin = 0x1p-20f;

enum class BvhLayout {
  Binary,  ///< DeviceBvhNode: two children, boxes in float32.
  Wide,    ///< DeviceWideNode: eight children, boxes in bytes.
};

/// The hierarchy in the layout of shared/bvh_layout.h. A walk needs a stack of `depth` entries.
struct DeviceBvh {
  /// One of them is empty, both for an empty Bvh: then there is nothing to trace against. Binary nodes are the inner
  /// nodes of the Bvh, in the Bvh's order.
  UnsetVector<DeviceBvhNode> nodes;
  UnsetVector<DeviceWideNode> wideNodes;
  UnsetVector<DeviceTriangle> triangles;  ///< One per slot; corners rounded to nearest.
  uint32_t depth = 0;

  [[nodiscard]] std::span<const std::byte> nodeBytes() const {
    return nodes.empty() ? std::as_bytes(std::span(wideNodes)) : std::as_bytes(std::span(nodes));
  }
};

/// Binary: a Bvh whose root is a leaf becomes one node with that leaf on both sides, of which the right one has a box
/// far away. Throws Error{Device} for more triangles than a reference can count.
[[nodiscard]] DeviceBvh encodeDeviceBvh(const Bvh& bvh, const TriangleMesh& mesh, const FaceGeometry& geometry,
                                        BvhLayout layout = BvhLayout::Binary);

}  // namespace asdfvk
