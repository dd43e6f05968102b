#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "bvh/bvh.h"

namespace asdfvk {

inline std::vector<uint32_t> everyFaceRepresentsItself(const Mesh& mesh) {
  std::vector<uint32_t> representatives(mesh.faces.size());
  std::iota(representatives.begin(), representatives.end(), 0u);
  return representatives;
}

inline Bvh buildOver(const Mesh& mesh, const BvhOptions& options = {}) {
  return buildBvh(mesh, computeFaceGeometry(mesh), everyFaceRepresentsItself(mesh), options);
}

inline bool holds(const BvhNode& node, const Vec3d& p) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (!(node.min[axis] <= p[axis] && p[axis] <= node.max[axis])) return false;
  return true;
}

inline bool holdsBox(const BvhNode& outer, const BvhNode& inner) {
  return holds(outer, Vec3d(inner.min)) && holds(outer, Vec3d(inner.max));
}

/// Checks all invariants of a hierarchy over exactly the faces `expectedFaces` (ascending).
inline void checkInvariants(const Bvh& bvh, const Mesh& mesh, const std::vector<uint32_t>& expectedFaces,
                            const BvhOptions& options = {}) {
  std::vector<uint32_t> faces(bvh.primitiveFaces.begin(), bvh.primitiveFaces.end());
  std::sort(faces.begin(), faces.end());
  CHECK(faces == expectedFaces);
  CHECK(bvh.nodes.empty() == expectedFaces.empty());
  CHECK(bvh.depth <= kMaxBvhDepth);
  if (bvh.nodes.empty()) return;

  std::vector<int> nodeVisits(bvh.nodes.size()), primitiveVisits(bvh.primitiveFaces.size());
  uint32_t deepest = 0;
  size_t badBoxes = 0, largeLeaves = 0;
  struct Entry {
    uint32_t node, level;
  };
  std::vector<Entry> stack = {{0, 0}};
  while (!stack.empty()) {
    const auto [index, level] = stack.back();
    stack.pop_back();
    REQUIRE(index < bvh.nodes.size());
    ++nodeVisits[index];
    REQUIRE(nodeVisits[index] == 1);
    deepest = std::max(deepest, level);
    const BvhNode& node = bvh.nodes[index];
    if (!node.isLeaf()) {
      for (const uint32_t child : {node.first, node.first + 1}) {
        REQUIRE(child < bvh.nodes.size());
        if (!holdsBox(node, bvh.nodes[child])) ++badBoxes;
        stack.push_back({child, level + 1});
      }
      continue;
    }
    if (node.triangleCount > options.maxLeafTriangleCount) ++largeLeaves;
    for (uint32_t primitive = node.first; primitive < node.first + node.triangleCount; ++primitive) {
      REQUIRE(primitive < bvh.primitiveFaces.size());
      ++primitiveVisits[primitive];
      for (const uint32_t vertex : mesh.faces[bvh.primitiveFaces[primitive]]) {
        const Vec3d p = bvh.normalization.toNormalized(mesh.vertices[vertex]);
        if (!holds(node, p) || !holds(node, Vec3d(Vec3f(p)))) ++badBoxes;
      }
    }
  }
  CHECK(badBoxes == 0);
  CHECK(largeLeaves == 0);
  CHECK(deepest == bvh.depth);
  CHECK(std::all_of(nodeVisits.begin(), nodeVisits.end(), [](int n) { return n == 1; }));
  CHECK(std::all_of(primitiveVisits.begin(), primitiveVisits.end(), [](int n) { return n == 1; }));
}

}  // namespace asdfvk
