#include "bvh/bvh.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <limits>
#include <numeric>

#include "bvh_invariants.h"
#include "bvh_meshes.h"
#include "core/check.h"
#include "support/bvh_statistics.h"

using namespace asdfvk;

TEST_CASE("a hierarchy over random triangles keeps its invariants") {
  for (const uint32_t count : {1u, 2u, 3u, 4u, 5u, 17u, 100u, 5000u, 30000u}) {
    const Mesh mesh = soup(count, count);
    checkInvariants(buildOver(mesh), mesh, everyFaceRepresentsItself(mesh));
  }
}

TEST_CASE("a hierarchy keeps its invariants for all options") {
  const Mesh mesh = sheet(30);
  for (const uint32_t leaf : {1u, 2u, 3u, kMaxLeafTriangleCount}) {
    for (const uint32_t bins : {2u, 3u, 16u, 32u}) {
      const BvhOptions options{leaf, bins};
      checkInvariants(buildOver(mesh, options), mesh, everyFaceRepresentsItself(mesh), options);
    }
  }
}

TEST_CASE("a hierarchy keeps its invariants far from the origin and in any unit") {
  for (const double scale : {1e-20, 1e-3, 1.0, 1e3, 1e30}) {
    Mesh mesh = sheet(20);
    for (Vec3d& v : mesh.vertices) v = (v + Vec3d{1e5, -2e5, 1. / 3}) * scale;
    checkInvariants(buildOver(mesh), mesh, everyFaceRepresentsItself(mesh));
  }
}

TEST_CASE("the bits do not depend on the number of threads") {
  const Mesh mesh = sheet(150);
  Bvh bvhs[3];
  for (const size_t threadCount : {1, 2, 3}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
    bvhs[threadCount - 1] = buildOver(mesh);
  }
  for (const Bvh& other : {bvhs[1], bvhs[2]}) {
    CHECK(other.primitiveFaces == bvhs[0].primitiveFaces);
    CHECK(other.depth == bvhs[0].depth);
    REQUIRE(other.nodes.size() == bvhs[0].nodes.size());
    CHECK(std::memcmp(other.nodes.data(), bvhs[0].nodes.data(), other.nodes.size() * sizeof(BvhNode)) == 0);
  }
}

TEST_CASE("a hierarchy is far better than a list") {
  const Mesh mesh = sheet(100);
  const BvhStatistics statistics = computeBvhStatistics(buildOver(mesh));
  CHECK(statistics.sahCost < 40);
  CHECK(statistics.sahCost > 1);
  CHECK(statistics.leafCount * 2 == statistics.nodeCount + 1);
  CHECK(statistics.depth == buildOver(mesh).depth);
  CHECK(computeBvhStatistics(buildOver(soup(1, 1))).sahCost == 1);
}

TEST_CASE("emptyMesh has an empty hierarchy") {
  const Bvh bvh = buildOver(Mesh{});
  checkInvariants(bvh, Mesh{}, {});
  CHECK(computeBvhStatistics(bvh).nodeCount == 0);
}

TEST_CASE("oneTriangle is a root that is a leaf") {
  const Mesh mesh = soup(1, 7);
  const Bvh bvh = buildOver(mesh);
  checkInvariants(bvh, mesh, {0});
  CHECK(bvh.depth == 0);
  CHECK(bvh.nodes.size() == 1);
}

TEST_CASE("identicalCentroids are split by index") {
  Mesh mesh;
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    // Both corners of each box are symmetric about the origin, with coordinates that are exact in float.
    const double r = (1.0 + random.index(64)) / 64;
    addTriangle(mesh, {-r, -r, -r}, {r, r, r}, {r, -r, 0});
  }
  const Bvh bvh = buildOver(mesh);
  checkInvariants(bvh, mesh, everyFaceRepresentsItself(mesh));
  CHECK(bvh.depth <= 18);  // 11 halvings down to eight triangles, and at most seven levels over those.
}

TEST_CASE("oneTriangleManyTimes is split by index") {
  Mesh mesh;
  for (int i = 0; i < 10000; ++i) addTriangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  checkInvariants(buildOver(mesh), mesh, everyFaceRepresentsItself(mesh));
}

TEST_CASE("geometricSeries, where SAH takes off one triangle after another, stays within the depth limit") {
  // The series runs towards the centre of the mesh, where floats resolve it over 126 octaves.
  Mesh mesh;
  addTriangle(mesh, {-1, 0, 0}, {-1, 0.01, 0}, {-1, 0, 0.01});
  for (int i = 0; i < 400; ++i) {
    const double s = std::exp2(-0.75 * i);
    addTriangle(mesh, {s, 0, 0}, {s, s * 0.01, 0}, {s, 0, s * 0.01});
  }
  const BvhOptions options{1, 2};
  const Bvh bvh = buildOver(mesh, options);
  checkInvariants(bvh, mesh, everyFaceRepresentsItself(mesh), options);
  CHECK(bvh.depth > kMaxBvhDepth - 8);
}

TEST_CASE("slivers keep the invariants") {
  Mesh mesh;
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d a = randomPoint(random), b = randomPoint(random);
    addTriangle(mesh, a, b, a + (b - a) * 0.5 + randomPoint(random) * 1e-6);
  }
  checkInvariants(buildOver(mesh), mesh, everyFaceRepresentsItself(mesh));
}

TEST_CASE("nanVertex and infinite vertices leave the other faces in the hierarchy") {
  Mesh mesh = soup(100, 9);
  mesh.vertices[3 * 10].y = std::numeric_limits<double>::quiet_NaN();
  mesh.vertices[3 * 20 + 1].x = std::numeric_limits<double>::infinity();
  std::vector<uint32_t> expected;
  for (uint32_t f = 0; f < 100; ++f)
    if (f != 10 && f != 20) expected.push_back(f);
  checkInvariants(buildOver(mesh), mesh, expected);
}

TEST_CASE("a hierarchy contains all faces of asWideAsDouble") {
  Mesh mesh = soup(100, 9);
  addTriangle(mesh, {-1.7e308, 0, 0}, {-1.6e308, 0, 0}, {-1.7e308, 1e307, 0});
  addTriangle(mesh, {1.7e308, 0, 0}, {1.6e308, 0, 0}, {1.7e308, 1e307, 0});
  std::vector<uint32_t> all(mesh.faces.size());
  std::iota(all.begin(), all.end(), 0u);
  checkInvariants(buildOver(mesh), mesh, all);
}

TEST_CASE("collinearRow and zero-area faces are left out") {
  Mesh mesh;
  for (int i = 0; i < 50; ++i) addTriangle(mesh, {1.0 * i, 0, 0}, {i + 1.0, 0, 0}, {i + 2.0, 0, 0});
  checkInvariants(buildOver(mesh), mesh, {});
  addTriangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  checkInvariants(buildOver(mesh), mesh, {50});
}

TEST_CASE("hugeAndManyTiny, and flatInOnePlane, keep the invariants") {
  Mesh mesh = soup(3000, 11, 1e-3);
  addTriangle(mesh, {-1e6, -1e6, 0}, {1e6, -1e6, 0}, {0, 1e6, 1});
  checkInvariants(buildOver(mesh), mesh, everyFaceRepresentsItself(mesh));
  for (Vec3d& v : mesh.vertices) v.z = 0.1;
  checkInvariants(buildOver(mesh), mesh, everyFaceRepresentsItself(mesh));
}

TEST_CASE("of coincident faces a hierarchy contains the representative only") {
  const Mesh mesh = soup(10, 13);
  std::vector<uint32_t> representatives = everyFaceRepresentsItself(mesh);
  representatives[7] = 2;
  checkInvariants(buildBvh(mesh, computeFaceGeometry(mesh), representatives), mesh, {0, 1, 2, 3, 4, 5, 6, 8, 9});
}

TEST_CASE("faces left out of a large mesh leave no gap") {
  const Mesh mesh = soup(20000, 17);
  std::vector<uint32_t> representatives = everyFaceRepresentsItself(mesh), expected;
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
    if (f % 7 == 3 || f / 5000 == 2)
      representatives[f] = 0;
    else
      expected.push_back(f);
  }
  checkInvariants(buildBvh(mesh, computeFaceGeometry(mesh), representatives), mesh, expected);
}

TEST_CASE("representatives for another mesh are a broken precondition") {
  const Mesh mesh = soup(10, 13);
  CHECK_THROWS_AS((void)buildBvh(mesh, computeFaceGeometry(mesh), std::vector<uint32_t>(9)), CheckFailure);
}
