#include "bvh/device_bvh.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "asdf_vk/error.h"
#include "bvh/wide_bvh.h"
#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr float kFarAway = 1e6f;
// Prefetch distance in primitives: faces of consecutive primitives may be far apart in memory.
constexpr size_t kPrefetchDistance = 16;

vec3 toDevice(const Vec3f& v) { return {v.x, v.y, v.z}; }
vec3 grownMin(const Vec3f& v) { return {v.x - kDeviceBoxMargin, v.y - kDeviceBoxMargin, v.z - kDeviceBoxMargin}; }
vec3 grownMax(const Vec3f& v) { return {v.x + kDeviceBoxMargin, v.y + kDeviceBoxMargin, v.z + kDeviceBoxMargin}; }

uint32_t leafReference(const BvhNode& leaf) {
  ASDFVK_CHECK_OP(leaf.triangleCount, <=, kMaxLeafTriangleCount);
  return leaf.first | leaf.triangleCount << kReferenceCountShift;
}

DeviceBvhNode encodeRootLeaf(const BvhNode& root) {
  return {.leftMin = grownMin(root.min),
          .left = leafReference(root),
          .leftMax = grownMax(root.max),
          .unused0 = 0,
          .rightMin = {kFarAway, kFarAway, kFarAway},
          .right = leafReference(root),
          .rightMax = {kFarAway, kFarAway, kFarAway},
          .unused1 = 0};
}

UnsetVector<DeviceBvhNode> encodeNodes(std::span<const BvhNode> nodes) {
  std::vector<uint32_t> innerIndex(nodes.size());  // Number of inner nodes before each node.
  uint32_t innerCount = 0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    innerIndex[i] = innerCount;
    innerCount += nodes[i].isLeaf() ? 0 : 1;
  }
  const auto referenceTo = [&](uint32_t child) {
    return nodes[child].isLeaf() ? leafReference(nodes[child]) : innerIndex[child];
  };
  UnsetVector<DeviceBvhNode> encoded(innerCount);
  forEachInParallel(nodes.size(), [&](size_t i) {
    if (nodes[i].isLeaf()) return;
    const uint32_t leftIndex = nodes[i].first;
    const BvhNode &left = nodes[leftIndex], &right = nodes[leftIndex + 1];
    encoded[innerIndex[i]] = {.leftMin = grownMin(left.min),
                              .left = referenceTo(leftIndex),
                              .leftMax = grownMax(left.max),
                              .unused0 = 0,
                              .rightMin = grownMin(right.min),
                              .right = referenceTo(leftIndex + 1),
                              .rightMax = grownMax(right.max),
                              .unused1 = 0};
  });
  return encoded;
}

struct OctahedralNormal {
  float u, v;
};

// Branch-free: the side of the sphere is unpredictable. -0 has the code of 0, as normals of reversed faces have.
OctahedralNormal encodeNormal(const Vec3d& n) {
  const double scale = 1 / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  const double u = n.x * scale, v = n.y * scale;
  const double foldedU = std::copysign(1 - std::abs(v), n.x + 0.0), foldedV = std::copysign(1 - std::abs(u), n.y + 0.0);
  const bool isUp = n.z >= 0;
  return {static_cast<float>(isUp ? u : foldedU), static_cast<float>(isUp ? v : foldedV)};
}

UnsetVector<DeviceTriangle> encodeTriangles(std::span<const uint32_t> primitiveFaces, const Bvh& bvh,
                                            const TriangleMesh& mesh, const FaceGeometry& geometry) {
  UnsetVector<DeviceTriangle> triangles(primitiveFaces.size());
  forEachInParallel(primitiveFaces.size(), [&](size_t primitive) {
    const uint32_t face = primitiveFaces[primitive];
    if (primitive + kPrefetchDistance < primitiveFaces.size()) {
      const uint32_t later = primitiveFaces[primitive + kPrefetchDistance];
      __builtin_prefetch(&mesh.faces[later]);
      __builtin_prefetch(&geometry.normals[later]);
    }
    const auto corner = [&](size_t k) {
      return toDevice(Vec3f(bvh.normalization.toNormalized(mesh.vertices[mesh.faces[face][k]])));
    };
    const OctahedralNormal normal = encodeNormal(geometry.normals[face]);
    triangles[primitive] = {corner(0), face, corner(1), normal.u, corner(2), normal.v};
  });
  return triangles;
}

}  // namespace

uint64_t maxBlockCount(const Bvh& bvh, BvhLayout layout) {
  const uint64_t innerCount = bvh.nodes.size() / 2;  // Each inner node has two children.
  // Each wide node replaces an inner node.
  const uint64_t perNode = layout == BvhLayout::Binary ? kBvhNodeTexelCount : kWideNodeTexelCount;
  return std::max(std::max<uint64_t>(1, innerCount) * perNode,
                  uint64_t{bvh.primitiveFaces.size()} * kBvhTriangleTexelCount);
}

DeviceBvh encodeDeviceBvh(const Bvh& bvh, const TriangleMesh& mesh, const FaceGeometry& geometry, BvhLayout layout) {
  DeviceBvh device;
  if (bvh.nodes.empty()) return device;
  if (bvh.primitiveFaces.size() > kReferenceFirstMask)
    throw Error(ErrorCode::DeviceLimit, fmt::format("the mesh has {} triangles and the device's hierarchy holds {}",
                                                    bvh.primitiveFaces.size(), kReferenceFirstMask));
  if (layout == BvhLayout::Wide) {
    WideBvh wide = encodeWideBvh(bvh);
    return {{}, std::move(wide.nodes), encodeTriangles(wide.primitiveFaces, bvh, mesh, geometry), wide.depth};
  }
  device.nodes =
      bvh.nodes[0].isLeaf() ? UnsetVector<DeviceBvhNode>{encodeRootLeaf(bvh.nodes[0])} : encodeNodes(bvh.nodes);
  device.triangles = encodeTriangles(bvh.primitiveFaces, bvh, mesh, geometry);
  device.depth = bvh.depth;
  return device;
}

}  // namespace asdfvk
