#include "bvh/normal_bounds.h"

#include <doctest/doctest.h>

#include <numeric>

#include "bvh/device_bvh.h"
#include "core/random.h"
#include "generate/shapes.h"

using namespace asdfvk;

namespace {

Vec3d randomDirection(Random& random) {
  const Vec3d v{random.real() - 0.5, random.real() - 0.5, random.real() - 0.5};
  return v / length(v);
}

}  // namespace

TEST_CASE("bounds never exclude a normal that they contain, and exclude most distant ones") {
  Random random(3);
  int excludedCount = 0;
  for (int i = 0; i < 2000; ++i) {
    NormalBounds bounds;
    std::vector<Vec3d> normals;
    const Vec3d centre = randomDirection(random);
    for (int k = 0; k < 4; ++k) {
      const Vec3d near = centre + 0.1 * randomDirection(random);
      normals.push_back(near / length(near));
      bounds.add(normals.back());
    }
    const Vec3d face = randomDirection(random);
    for (const Vec3d& normal : normals) CHECK(NormalBoundsTest(face, dot(face, normal)).mayHold(bounds));
    if (dot(face, centre) > 0) excludedCount += NormalBoundsTest(face, -0.5).mayHold(bounds) ? 0 : 1;
  }
  CHECK(excludedCount > 900);
  for (const Vec3d& n : {Vec3d{0, 0, 1}, Vec3d{-1, 0, 0}, Vec3d{0, -1, 0}})
    CHECK(NormalBoundsTest(n, -1).mayHold(NormalBounds{kAnyNormals}));
}

TEST_CASE("the bounds of each node contain the normals below it, in every layout") {
  const Mesh mesh = makeSphere(3000).mesh;
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  std::vector<uint32_t> representatives(mesh.faces.size());
  std::iota(representatives.begin(), representatives.end(), 0u);
  const Bvh bvh = buildBvh(mesh, geometry, representatives);
  const std::vector<NormalBounds> bounds = normalBoundsOf(bvh, geometry);
  REQUIRE(bounds.size() == bvh.nodes.size());
  const auto contains = [&](NormalBounds outer, const Vec3d& normal) {
    NormalBounds both = outer;
    both.add(normal);
    return both.bits == outer.bits;
  };
  const auto containsAll = [&](NormalBounds outer, NormalBounds inner) {
    inner.add(outer);
    return inner.bits == outer.bits;
  };
  size_t badCount = 0;
  for (size_t i = 0; i < bvh.nodes.size(); ++i) {
    const BvhNode& node = bvh.nodes[i];
    for (uint32_t p = node.first; p < node.first + node.triangleCount; ++p)
      badCount += contains(bounds[i], geometry.normals[bvh.primitiveFaces[p]]) ? 0 : 1;
    if (node.isLeaf()) continue;
    for (const uint32_t child : {node.first, node.first + 1}) badCount += containsAll(bounds[i], bounds[child]) ? 0 : 1;
  }
  CHECK(badCount == 0);

  DeviceBvh binary = encodeDeviceBvh(bvh, mesh, geometry, BvhLayout::Binary);
  CHECK(binary.nodes[0].leftNormals == kAnyNormals);
  binary.addNormalBounds(geometry);
  // Device nodes are the inner nodes in the same order.
  size_t deviceNode = 0;
  for (const BvhNode& node : bvh.nodes) {
    if (node.isLeaf()) continue;
    CHECK(binary.nodes[deviceNode].leftNormals == bounds[node.first].bits);
    CHECK(binary.nodes[deviceNode++].rightNormals == bounds[node.first + 1].bits);
  }

  DeviceBvh wide = encodeDeviceBvh(bvh, mesh, geometry, BvhLayout::Wide);
  wide.addNormalBounds(geometry);
  REQUIRE(wide.childNormals.size() == wide.wideNodes.size());
  NormalBounds root;
  for (const uint32_t bits : wide.childNormals[0]) root.add(NormalBounds{bits});
  CHECK(root.bits == bounds[0].bits);
  for (size_t i = 0; i < wide.wideNodes.size(); ++i) {
    const DeviceWideNode& node = wide.wideNodes[i];
    uint32_t child = node.childBase, triangle = node.triangleBase;
    for (uint32_t slot = 0; slot < kWideChildCount; ++slot) {
      const uint32_t kind = node.childBits >> 4 * slot & 15;
      const NormalBounds own{wide.childNormals[i][slot]};
      if (kind == 0) CHECK(own.bits == kNoNormals);
      for (uint32_t bits = kind; kind != 8 && bits != 0; bits >>= 1)
        badCount += contains(own, geometry.normals[wide.triangles[triangle++].faceIndex]) ? 0 : 1;
      if (kind != 8) continue;
      for (const uint32_t bits : wide.childNormals[child]) badCount += containsAll(own, NormalBounds{bits}) ? 0 : 1;
      ++child;
    }
  }
  CHECK(badCount == 0);
}
