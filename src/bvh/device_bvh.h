#pragma once

#include <cstddef>
#include <cstdint>

#include "bvh/bvh.h"
#include "core/unset_vector.h"
#include "mesh/face_geometry.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// The hierarchy in the layout of shared/bvh_layout.h. Empty for an empty Bvh.
struct DeviceBvh {
  UnsetVector<DeviceWideNode> nodes;
  UnsetVector<DeviceTriangle> triangles;  ///< One per primitive; corners rounded to nearest.
};

inline constexpr size_t kDeviceBlockByteCount = 16;  ///< A texel, or a uvec4 of a storage buffer.

/// Upper bound of the block count of the largest array that encodeDeviceBvh() returns.
[[nodiscard]] uint64_t maxBlockCount(const Bvh& bvh);

[[nodiscard]] DeviceBvh encodeDeviceBvh(const Bvh& bvh, const TriangleMesh& mesh, const FaceGeometry& geometry);

}  // namespace asdfvk
