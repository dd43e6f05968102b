#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bvh/bvh.h"
#include "mesh/face_geometry.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

inline constexpr size_t kDeviceBlockByteCount = 16;  ///< A texel, or a uvec4 of a storage buffer.

/// Upper bound of the block count of the nodes and of the triangles on a device.
[[nodiscard]] uint64_t maxBlockCount(const Bvh& bvh);

/// Writes the triangles of consecutive primitives, with corners rounded to nearest. primitiveFaces: the faces of these
/// primitives (WideBvh::primitiveFaces). triangles: one per primitive; written once, in order.
void encodeTriangles(const Bvh& bvh, const TriangleMesh& mesh, const FaceGeometry& geometry,
                     std::span<const uint32_t> primitiveFaces, std::span<DeviceTriangle> triangles);

}  // namespace asdfvk
