#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/unset_vector.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// A cone on the device.
struct DeviceCone {
  uint32_t seed;  ///< ConeSeed::triangle; kNoFace if the device cannot trace the cone.
  uint32_t index;
};

/// DeviceCone::seed of every face, 4 bytes per face. Reading an entry takes one random access. Computing an entry takes
/// four accesses: to triangles, representatives, areas and normals of the mesh.
class DeviceSeeds {
 public:
  /// primitiveFaces: the faces of the triangles on the device.
  DeviceSeeds(const TraceScene& scene, std::span<const uint32_t> primitiveFaces);

  /// The cones of these faces in the order of their triangles, because neighbouring cones traverse the same nodes.
  /// Cones that the device cannot trace come last, in any order.
  [[nodiscard]] UnsetVector<DeviceCone> inDeviceOrder(std::span<const uint32_t> faces) const;

 private:
  [[nodiscard]] bool collect(std::span<const uint32_t> faces, UnsetVector<DeviceCone>& cones) const;

  std::vector<uint32_t> codes_;  // #F, DeviceCone::seed
  uint32_t triangleCount_;
};

}  // namespace asdfvk
