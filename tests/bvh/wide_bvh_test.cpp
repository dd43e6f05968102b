#include "bvh/wide_bvh.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "bvh/wide_boxes.h"
#include "bvh/wide_collapse.h"
#include "bvh/wide_slots.h"
#include "bvh_invariants.h"
#include "bvh_meshes.h"
#include "device_hierarchy.h"

using namespace asdfvk;

namespace {

DeviceHierarchy encodeWide(const Mesh& mesh, const BvhOptions& options = {}) {
  return encodeForDevice(buildOver(mesh, options), mesh, computeFaceGeometry(mesh));
}

struct Walked {
  std::vector<int> nodeVisits, triangleVisits;
  size_t cornersOutside = 0;
  uint32_t depth = 0;
};

// Byte `slot` of the lower (corner 0) or upper (corner 1) bounds, by its address in the node.
double plane(const DeviceWideNode& node, size_t axis, uint32_t slot, uint32_t corner) {
  unsigned char bytes[sizeof(DeviceWideNode)];
  std::memcpy(bytes, &node, sizeof node);
  float origin[3];
  std::memcpy(origin, bytes, sizeof origin);
  return origin[axis] + std::exp2(int{bytes[12 + axis]} - 127) * bytes[32 + 16 * axis + 8 * corner + slot];
}

// Distance of a point from the box of the child in `slot`; negative inside.
double distanceOutside(const DeviceWideNode& node, uint32_t slot, const vec3& p) {
  const double coordinates[3] = {p.x, p.y, p.z};
  double distance = -1;
  for (size_t axis = 0; axis < 3; ++axis)
    distance = std::max(
        {distance, plane(node, axis, slot, 0) - coordinates[axis], coordinates[axis] - plane(node, axis, slot, 1)});
  return distance;
}

struct Entered {
  uint32_t node, slot;
};

// path: the slots entered on the way from the root.
void walk(const DeviceHierarchy& bvh, uint32_t index, std::vector<Entered>& path, Walked& walked) {
  REQUIRE(index < bvh.wide.nodes.size());
  REQUIRE(++walked.nodeVisits[index] == 1);
  walked.depth = std::max(walked.depth, static_cast<uint32_t>(path.size()));
  const DeviceWideNode& node = bvh.wide.nodes[index];
  uint32_t child = node.childBase, triangle = node.triangleBase;
  for (uint32_t slot = 0; slot < 8; ++slot) {
    const uint32_t bits = node.childBits >> 4 * slot & 15;
    path.push_back({index, slot});
    if (bits == 8) {
      walk(bvh, child++, path, walked);
    } else if (bits != 0) {
      REQUIRE((bits == 1 || bits == 3 || bits == 7));
      for (uint32_t i = 0; i < (bits == 7 ? 3 : bits == 3 ? 2 : 1); ++i, ++triangle) {
        REQUIRE(triangle < bvh.triangles.size());
        REQUIRE(++walked.triangleVisits[triangle] == 1);
        const DeviceTriangle& t = bvh.triangles[triangle];
        for (const vec3& corner : {t.v0, t.v1, t.v2})
          for (const Entered& entered : path)
            walked.cornersOutside += distanceOutside(bvh.wide.nodes[entered.node], entered.slot, corner) > -0x1p-20;
      }
    } else {
      for (size_t axis = 0; axis < 3; ++axis) REQUIRE(plane(node, axis, slot, 0) > plane(node, axis, slot, 1));
    }
    path.pop_back();
  }
}

void checkWide(const Mesh& mesh, const BvhOptions& options = {}) {
  const DeviceHierarchy bvh = encodeWide(mesh, options);
  Walked walked{std::vector<int>(bvh.wide.nodes.size()), std::vector<int>(bvh.triangles.size()), 0, 0};
  std::vector<Entered> path;
  walk(bvh, 0, path, walked);
  CHECK(walked.cornersOutside == 0);
  CHECK(walked.depth <= kMaxBvhDepth);
  CHECK(std::all_of(walked.nodeVisits.begin(), walked.nodeVisits.end(), [](int n) { return n == 1; }));
  CHECK(std::all_of(walked.triangleVisits.begin(), walked.triangleVisits.end(), [](int n) { return n == 1; }));
  std::vector<uint32_t> faces;
  for (const DeviceTriangle& triangle : bvh.triangles) faces.push_back(triangle.faceIndex);
  std::sort(faces.begin(), faces.end());
  CHECK(faces == everyFaceRepresentsItself(mesh));
}

float halfArea(const BvhNode& node) { return Box3f{node.min, node.max}.halfArea(); }

// The least cost of a subtree as at most `rootCount` children, by exhaustive search. Costs as in WideCollapse.
double leastCost(std::span<const BvhNode> nodes, uint32_t node, uint32_t rootCount) {
  const auto slotCount = [&](auto&& self, uint32_t n) -> uint32_t {
    return nodes[n].isLeaf() ? nodes[n].triangleCount : self(self, nodes[n].first) + self(self, nodes[n].first + 1);
  };
  const auto shared = [&](uint32_t count) {
    double least = 1e30;
    for (uint32_t k = 1; k < count; ++k)
      least =
          std::min(least, leastCost(nodes, nodes[node].first, k) + leastCost(nodes, nodes[node].first + 1, count - k));
    return least;
  };
  double least = 1e30;
  const uint32_t count = slotCount(slotCount, node);
  if (count <= kMaxWideLeafTriangleCount) least = halfArea(nodes[node]) * count;
  if (nodes[node].isLeaf()) return least;
  least = std::min(least, halfArea(nodes[node]) * WideCosts{}.node + shared(kWideChildCount));
  for (uint32_t i = 2; i <= rootCount; ++i) least = std::min(least, shared(i));
  return least;
}

double costOf(std::span<const BvhNode> nodes, const WideCollapse& collapse, uint32_t node) {
  double cost = halfArea(nodes[node]) * WideCosts{}.node;
  const WideChildren children = collapse.childrenOf(node);
  for (const WideChild& child : children.all())
    cost += child.isLeaf ? halfArea(nodes[child.node]) * collapse.primitivesOf(child.node).count
                         : costOf(nodes, collapse, child.node);
  return cost;
}

}  // namespace

TEST_CASE("a wide hierarchy holds each triangle once, inside the boxes on its way") {
  for (const uint32_t count : {1u, 2u, 3u, 4u, 5u, 9u, 17u, 100u, 5000u}) {
    CAPTURE(count);
    checkWide(soup(count, count));
  }
  checkWide(soup(3, 3, 100));  // a root that is a leaf
  checkWide(sheet(90));
}

TEST_CASE("a wide hierarchy may have leaves of any size") {
  for (const uint32_t leaf : {1u, 2u, 3u}) checkWide(sheet(20), BvhOptions{leaf, 16});
}

TEST_CASE("a wide hierarchy of far, flat, huge, tiny and equal triangles keeps its invariants") {
  Mesh mesh = soup(3000, 11, 1e-3);
  addTriangle(mesh, {-1e6, -1e6, 0}, {1e6, -1e6, 0}, {0, 1e6, 1});
  checkWide(mesh);
  for (Vec3d& v : mesh.vertices) v.z = 0.1;
  checkWide(mesh);
  Mesh same;
  for (int i = 0; i < 100; ++i) addTriangle(same, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  checkWide(same);
  Mesh series;  // SAH takes off one after another.
  for (int i = 0; i < 400; ++i) {
    const double s = std::exp2(-0.75 * i);
    addTriangle(series, {s, 0, 0}, {s, s * 0.01, 0}, {s, 0, s * 0.01});
  }
  checkWide(series, BvhOptions{1, 2});
}

TEST_CASE("the wide layout of an empty hierarchy is empty") {
  const WideBvh bvh = encodeWideBvh(Bvh{});
  CHECK(bvh.nodes.empty());
  CHECK(bvh.primitiveFaces.empty());
}

TEST_CASE("the bits of a wide hierarchy do not depend on the number of threads") {
  const Mesh mesh = sheet(100);
  const DeviceHierarchy expected = encodeWide(mesh);
  for (const size_t threadCount : {1, 2, 3}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
    const DeviceHierarchy bvh = encodeWide(mesh);
    REQUIRE(bvh.wide.nodes.size() == expected.wide.nodes.size());
    CHECK(std::memcmp(bvh.wide.nodes.data(), expected.wide.nodes.data(),
                      sizeof(DeviceWideNode) * bvh.wide.nodes.size()) == 0);
    REQUIRE(bvh.triangles.size() == expected.triangles.size());
    CHECK(std::memcmp(bvh.triangles.data(), expected.triangles.data(), 48 * bvh.triangles.size()) == 0);
  }
}

TEST_CASE("the collapse is the cheapest there is") {
  for (const uint32_t seed : {1u, 2u, 3u, 4u, 5u}) {
    CAPTURE(seed);
    const Mesh mesh = soup(22, seed, 0.4);
    const Bvh bvh = buildOver(mesh, {1, 16});
    const WideCollapse collapse(bvh.nodes);
    const double own = halfArea(bvh.nodes[0]) * WideCosts{}.node, cost = costOf(bvh.nodes, collapse, 0);
    double least = 1e30;
    for (uint32_t k = 1; k < 8; ++k)
      least = std::min(least, own + leastCost(bvh.nodes, 1, k) + leastCost(bvh.nodes, 2, 8 - k));
    CHECK(cost == doctest::Approx(least).epsilon(1e-5));
  }
}

TEST_CASE("children take the slots of the octants they are in") {
  std::vector<Box3f> boxes;
  for (const uint32_t octant : {3u, 0u, 7u, 5u, 6u, 1u, 2u, 4u}) {
    const Vec3f corner{octant & 1 ? 1.f : -1.f, octant & 2 ? 1.f : -1.f, octant & 4 ? 1.f : -1.f};
    boxes.push_back({corner, corner + Vec3f{0.5f, 0.5f, 0.5f}});
  }
  CHECK(chooseSlots(boxes) == std::array<uint32_t, 8>{3, 0, 7, 5, 6, 1, 2, 4});
  const std::vector<Box3f> pair = {{{2, 0, 0}, {3, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}};
  const auto slots = chooseSlots(pair);
  CHECK((slots[0] & 1) == 1);
  CHECK((slots[1] & 1) == 0);
}

TEST_CASE("quantised boxes are as tight as their bytes allow") {
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    std::vector<Box3f> boxes(1 + static_cast<size_t>(random.index(8)));
    Box3f all;
    for (Box3f& box : boxes) {
      for (int corner = 0; corner < 2; ++corner)
        box.add(Vec3f(randomPoint(random) * std::exp2(-static_cast<double>(i % 18))));
      all.add(box);
    }
    const auto slots = chooseSlots(boxes);
    const DeviceWideNode node = quantizeBoxes(boxes, slots);
    for (size_t b = 0; b < boxes.size(); ++b) {
      for (size_t axis = 0; axis < 3; ++axis) {
        const double step = (all.size()[axis] + 4 * kWideBoxMargin) * 2 / 255, margin = kWideBoxMargin;
        const double below = boxes[b].min[axis] - plane(node, axis, slots[b], 0);
        const double above = plane(node, axis, slots[b], 1) - boxes[b].max[axis];
        REQUIRE(below >= margin * 0.75);
        REQUIRE(above >= margin * 0.75);
        REQUIRE(below <= margin + step * 1.01);
        REQUIRE(above <= margin + step * 1.01);
      }
    }
  }
}
