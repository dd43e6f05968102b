#include "smooth/bilateral.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "core/check.h"
#include "sample_fields.h"

using namespace asdfvk;

namespace {

std::vector<uint32_t> sortedRing(const RingWindow& window, uint32_t ring) {
  std::vector<uint32_t> faces(window.ring(ring).begin(), window.ring(ring).end());
  std::sort(faces.begin(), faces.end());
  return faces;
}

using Faces = std::vector<uint32_t>;

}  // namespace

TEST_CASE("the rings of a tetrahedron are the face, the three others, and empty ones") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  RingWindow window;
  window.gather(buildDualGraph(mesh), 2, 4);
  CHECK(sortedRing(window, 0) == Faces{2});
  CHECK(sortedRing(window, 1) == Faces{0, 1, 3});
  for (uint32_t ring : {2u, 3u, 4u}) CHECK(window.ring(ring).empty());
  CHECK(window.faces().size() == 4);
}

TEST_CASE("the rings of a strip extend in both directions to its ends") {
  RingWindow window;
  const DualGraph graph = test::stripGraph(9);
  window.gather(graph, 6, 4);
  CHECK(sortedRing(window, 1) == Faces{5, 7});
  CHECK(sortedRing(window, 2) == Faces{4, 8});
  CHECK(sortedRing(window, 3) == Faces{3});
  CHECK(sortedRing(window, 4) == Faces{2});
  window.gather(graph, 0, 2);
  CHECK(sortedRing(window, 1) == Faces{1});
  CHECK(sortedRing(window, 2) == Faces{2});
  CHECK(window.faces().size() == 3);
}

TEST_CASE("rings are the distances of a search over the whole graph") {
  for (const char* shape : {"torus", "animal"}) {
    const DualGraph graph = buildDualGraph(generateShape(shape, 2000).mesh);
    RingWindow window;
    for (uint32_t face = 0; face < graph.faceCount(); face += 7) {
      const std::vector<uint32_t> hops = test::hopsFrom(graph, face, 4);
      for (uint32_t ringCount : {1u, 2u, 3u, 4u}) {
        window.gather(graph, face, ringCount);
        for (uint32_t ring = 0; ring <= ringCount; ++ring) {
          Faces expected;
          for (uint32_t other = 0; other < graph.faceCount(); ++other)
            if (hops[other] == ring) expected.push_back(other);
          REQUIRE(sortedRing(window, ring) == expected);
        }
      }
    }
  }
}

TEST_CASE("a window with very many faces at an edge is cut off and has no face twice") {
  RingWindow window;
  window.gather(test::coincidentGraph(33), 4, 4);
  CHECK(window.ring(1).size() == 32);
  CHECK(window.faces().size() == 33);
  window.gather(test::completeGraph(70), 50, 2);
  CHECK(window.faces().size() == kMaxWindowFaceCount);
  CHECK(std::set<uint32_t>(window.faces().begin(), window.faces().end()).size() == kMaxWindowFaceCount);
  CHECK(window.ring(2).empty());
}

TEST_CASE("a window is gathered along at most kMaxWindowArcCount arcs") {
  std::vector<std::vector<uint32_t>> rows(3);
  rows[0].assign(kMaxWindowArcCount - 1, 1);
  rows[0].push_back(2);
  RingWindow window;
  window.gather(test::graphOf(rows), 0, 1);
  CHECK(sortedRing(window, 1) == Faces{1, 2});
  rows[0].insert(rows[0].begin(), 1);
  window.gather(test::graphOf(rows), 0, 1);
  CHECK(sortedRing(window, 1) == Faces{1});
}

TEST_CASE("0 rings and too many rings fail a check") {
  RingWindow window;
  CHECK_THROWS_AS(window.gather(test::stripGraph(3), 0, 0), CheckFailure);
  CHECK_THROWS_AS(window.gather(test::stripGraph(3), 0, kMaxBilateralWindow + 1), CheckFailure);
}
