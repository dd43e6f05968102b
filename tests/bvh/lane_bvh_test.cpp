#include "bvh/lane_bvh.h"

#include <doctest/doctest.h>

#include <vector>

#include "bvh_invariants.h"
#include "generate/shapes.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

struct Encoded {
  Mesh source;
  TriangleMesh mesh{source};
  Bvh bvh;
  LaneBvh lanes = encodeLaneBvh(bvh, mesh);

  explicit Encoded(Mesh shape, const BvhOptions& options = {})
      : source(std::move(shape)), bvh(buildOver(source, options)) {}
};

/// Checks the boxes below a reference, counts the primitives, and returns the number of levels.
uint32_t visit(const Encoded& encoded, uint32_t reference, const Box3f& box, std::vector<uint32_t>& counts) {
  if ((reference & kLaneBlockBit) != 0) {
    const LaneBlock& block = encoded.lanes.blocks[reference & ~kLaneBlockBit];
    REQUIRE(block.triangleCount >= 1);
    REQUIRE(block.triangleCount <= kBvhLaneCount);
    for (uint32_t lane = 0; lane < kBvhLaneCount; ++lane)
      for (size_t k = 0; k < 3; ++k)
        for (size_t axis = 0; axis < 3; ++axis) {
          const float x = block.corners[k][axis][lane];
          if (lane >= block.triangleCount) {
            CHECK(x == 0);
            continue;
          }
          const Face& face = encoded.mesh.faces[encoded.bvh.primitiveFaces[block.firstPrimitive + lane]];
          const Vec3d corner = encoded.bvh.normalization.toNormalized(encoded.mesh.vertices[face[k]]);
          CHECK(x == static_cast<float>(corner[axis]));
          CHECK(box.min[axis] <= x);
          CHECK(x <= box.max[axis]);
        }
    for (uint32_t lane = 0; lane < block.triangleCount; ++lane) ++counts.at(block.firstPrimitive + lane);
    return 0;
  }
  const LaneNode& node = encoded.lanes.nodes.at(reference);
  uint32_t levels = 0;
  for (size_t slot = 0; slot < kBvhLaneCount; ++slot) {
    Box3f child;
    for (size_t axis = 0; axis < 3; ++axis) {
      child.min[axis] = node.planes[axis][0][slot];
      child.max[axis] = node.planes[axis][1][slot];
    }
    if (child.min.x > child.max.x) continue;  // No child.
    for (size_t axis = 0; axis < 3; ++axis) {
      CHECK(box.min[axis] <= child.min[axis]);
      CHECK(child.max[axis] <= box.max[axis]);
    }
    levels = std::max(levels, visit(encoded, node.children[slot], child, counts) + 1);
  }
  return levels;
}

}  // namespace

TEST_CASE("in the layout of the CPU each primitive is in one block, and boxes contain what is below them") {
  const Mesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  for (const Mesh& mesh : {one, shapes::box({1, 2, 3}), generateShape("animal", 3000).mesh, shapes::soup(1000, 3)})
    for (const uint32_t leaf : {kMaxWideLeafTriangleCount, kMaxLeafTriangleCount}) {
      const Encoded encoded(mesh, {.maxLeafTriangleCount = leaf});
      CAPTURE(encoded.bvh.primitiveFaces.size());
      std::vector<uint32_t> counts(encoded.bvh.primitiveFaces.size());
      const Box3f all{{-2, -2, -2}, {2, 2, 2}};
      CHECK(visit(encoded, 0, all, counts) <= encoded.lanes.depth + 1);
      CHECK(std::all_of(counts.begin(), counts.end(), [](uint32_t count) { return count == 1; }));
    }
}

TEST_CASE("a mesh without triangles has an empty layout of the CPU") {
  const Encoded encoded(Mesh{{{0, 0, 0}}, {}, {}});
  CHECK(encoded.lanes.nodes.empty());
  CHECK(encoded.lanes.blocks.empty());
}
