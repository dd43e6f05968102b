#pragma once

#include <vector>

#include "bvh/device_bvh.h"
#include "bvh/wide_bvh.h"

namespace asdfvk {

/// A hierarchy as a device has it.
struct DeviceHierarchy {
  WideBvh wide;
  std::vector<DeviceTriangle> triangles;
};

inline DeviceHierarchy encodeForDevice(const Bvh& bvh, const TriangleMesh& mesh, const FaceGeometry& geometry) {
  DeviceHierarchy encoded{encodeWideBvh(bvh), {}};
  encoded.triangles.resize(encoded.wide.primitiveFaces.size());
  encodeTriangles(bvh, mesh, geometry, encoded.wide.primitiveFaces, encoded.triangles);
  return encoded;
}

}  // namespace asdfvk
