#include "bvh/device_bvh.h"

#include <tbb/parallel_for.h>

namespace asdfvk {
namespace {

vec3 toDevice(const Vec3f& v) { return {v.x, v.y, v.z}; }

DeviceBvhNode encodeRootLeaf(const BvhNode& root) {
  return {.leftMin = toDevice(root.min),
          .leftFirst = root.first,
          .leftMax = toDevice(root.max),
          .leftCount = root.triangleCount,
          .rightMin = {2, 2, 2},
          .rightFirst = 0,
          .rightMax = {-2, -2, -2},
          .rightCount = 1};
}

// innerIndex: for each node the number of inner nodes before it.
std::vector<DeviceBvhNode> encodeNodes(const std::vector<BvhNode>& nodes) {
  std::vector<uint32_t> innerIndex(nodes.size());
  uint32_t innerCount = 0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    innerIndex[i] = innerCount;
    innerCount += nodes[i].isLeaf() ? 0 : 1;
  }
  const auto target = [&](uint32_t child) { return nodes[child].isLeaf() ? nodes[child].first : innerIndex[child]; };
  std::vector<DeviceBvhNode> encoded(innerCount);
  tbb::parallel_for(size_t{0}, nodes.size(), [&](size_t i) {
    if (nodes[i].isLeaf()) return;
    const uint32_t leftIndex = nodes[i].first;
    const BvhNode &left = nodes[leftIndex], &right = nodes[leftIndex + 1];
    encoded[innerIndex[i]] = {.leftMin = toDevice(left.min),
                              .leftFirst = target(leftIndex),
                              .leftMax = toDevice(left.max),
                              .leftCount = left.triangleCount,
                              .rightMin = toDevice(right.min),
                              .rightFirst = target(leftIndex + 1),
                              .rightMax = toDevice(right.max),
                              .rightCount = right.triangleCount};
  });
  return encoded;
}

}  // namespace

DeviceBvh encodeDeviceBvh(const Bvh& bvh, const Mesh& mesh) {
  DeviceBvh device;
  if (bvh.nodes.empty()) return device;
  if (bvh.nodes[0].isLeaf())
    device.nodes = {encodeRootLeaf(bvh.nodes[0])};
  else
    device.nodes = encodeNodes(bvh.nodes);

  device.triangles.resize(bvh.slotFaces.size());
  tbb::parallel_for(size_t{0}, bvh.slotFaces.size(), [&](size_t slot) {
    const uint32_t face = bvh.slotFaces[slot];
    const auto corner = [&](size_t k) {
      return toDevice(Vec3f(bvh.normalization.toNormalized(mesh.vertices[mesh.faces[face][k]])));
    };
    device.triangles[slot] = {corner(0), face, corner(1), 0, corner(2), 0};
  });
  return device;
}

}  // namespace asdfvk
