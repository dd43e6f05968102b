#include "bvh/device_bvh.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "bvh_invariants.h"
#include "bvh_meshes.h"

using namespace asdfvk;

namespace {

using Texel = std::array<uint32_t, 4>;

template <typename T>
std::vector<Texel> texelsOf(const UnsetVector<T>& items) {
  std::vector<Texel> texels(items.size() * sizeof(T) / sizeof(Texel));
  if (!items.empty()) std::memcpy(texels.data(), items.data(), items.size() * sizeof(T));
  return texels;
}

float asFloat(uint32_t bits) {
  float f = 0;
  std::memcpy(&f, &bits, 4);
  return f;
}

Vec3f pointOf(const Texel& texel) { return {asFloat(texel[0]), asFloat(texel[1]), asFloat(texel[2])}; }

// One child as the shader decodes it, from two texels of its parent.
struct Child {
  Vec3f min, max;
  uint32_t first = 0, count = 0;
};

Child childOf(const std::vector<Texel>& texels, uint32_t node, uint32_t side) {
  const Texel &lower = texels[4 * node + 2 * side], &upper = texels[4 * node + 2 * side + 1];
  return {pointOf(lower), pointOf(upper), lower[3] & 0x0fffffffu, lower[3] >> 28};
}

Vec3f grown(const Vec3f& corner, float margin) { return corner + Vec3f{margin, margin, margin}; }

// The octahedral map of Cigolle et al. 2014, back to a direction.
Vec3d normalOf(float u, float v) {
  Vec3d n{u, v, 1.0 - std::abs(u) - std::abs(v)};
  if (n.z < 0) {
    n.x = std::copysign(1.0 - std::abs(v), u);
    n.y = std::copysign(1.0 - std::abs(u), v);
  }
  return n / length(n);
}

// Traverses both trees together and counts the visited device nodes.
size_t countEqualNodes(const Bvh& bvh, uint32_t index, const std::vector<Texel>& texels, uint32_t deviceIndex) {
  size_t count = 1;
  for (uint32_t side = 0; side < 2; ++side) {
    const uint32_t childIndex = bvh.nodes[index].first + side;
    const BvhNode& expected = bvh.nodes[childIndex];
    const Child child = childOf(texels, deviceIndex, side);
    REQUIRE(child.count == expected.triangleCount);
    REQUIRE(child.min == grown(expected.min, -kDeviceBoxMargin));
    REQUIRE(child.max == grown(expected.max, kDeviceBoxMargin));
    if (expected.isLeaf())
      REQUIRE(child.first == expected.first);
    else
      count += countEqualNodes(bvh, childIndex, texels, child.first);
  }
  return count;
}

void checkTriangles(const Bvh& bvh, const Mesh& mesh, const std::vector<Texel>& texels) {
  REQUIRE(texels.size() == 3 * bvh.primitiveFaces.size());
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  for (size_t primitive = 0; primitive < bvh.primitiveFaces.size(); ++primitive) {
    const uint32_t face = bvh.primitiveFaces[primitive];
    REQUIRE(texels[3 * primitive][3] == face);
    const Vec3d normal = normalOf(asFloat(texels[3 * primitive + 1][3]), asFloat(texels[3 * primitive + 2][3]));
    REQUIRE(length(normal - geometry.normals[face]) < 3e-7);
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d p = bvh.normalization.toNormalized(mesh.vertices[mesh.faces[face][k]]);
      REQUIRE(pointOf(texels[3 * primitive + k]) == Vec3f(p));
    }
  }
}

}  // namespace

TEST_CASE("the device's texels decode to the same tree, boxes and triangles") {
  for (const Mesh& mesh : {soup(5, 1), soup(1000, 2), sheet(90)}) {
    const Bvh bvh = buildOver(mesh);
    REQUIRE(!bvh.nodes[0].isLeaf());
    const DeviceBvh device = encodeDeviceBvh(bvh, mesh, computeFaceGeometry(mesh));
    const size_t innerCount = (bvh.nodes.size() - 1) / 2;
    CHECK(device.nodes.size() == innerCount);
    CHECK(countEqualNodes(bvh, 0, texelsOf(device.nodes), 0) == innerCount);
    checkTriangles(bvh, mesh, texelsOf(device.triangles));
  }
}

TEST_CASE("a root that is a leaf becomes a node with a box far away on its right") {
  for (const uint32_t count : {1u, 3u}) {
    Mesh mesh;  // Large overlapping triangles: SAH does not split them.
    for (uint32_t i = 0; i < count; ++i) addTriangle(mesh, {0, 0, 1e-3 * i}, {1, 0, 0.5}, {0, 1, 0.7});
    const Bvh bvh = buildOver(mesh);
    REQUIRE(bvh.nodes.size() == 1);
    const DeviceBvh device = encodeDeviceBvh(bvh, mesh, computeFaceGeometry(mesh));
    REQUIRE(device.nodes.size() == 1);
    const std::vector<Texel> texels = texelsOf(device.nodes);
    const Child left = childOf(texels, 0, 0), right = childOf(texels, 0, 1);
    CHECK(left.min == grown(bvh.nodes[0].min, -kDeviceBoxMargin));
    CHECK(left.max == grown(bvh.nodes[0].max, kDeviceBoxMargin));
    CHECK(left.first == 0);
    CHECK(left.count == count);
    for (size_t axis = 0; axis < 3; ++axis) CHECK(right.min[axis] > 1000);
    CHECK(right.count == count);  // It is a leaf too: a reference to an inner node 0 would be a cycle.
    CHECK(right.first == 0);
    checkTriangles(bvh, mesh, texelsOf(device.triangles));
  }
}

TEST_CASE("an empty hierarchy has empty arrays") {
  const DeviceBvh device = encodeDeviceBvh(Bvh{}, Mesh{}, FaceGeometry{});
  CHECK(device.nodes.empty());
  CHECK(device.triangles.empty());
}
