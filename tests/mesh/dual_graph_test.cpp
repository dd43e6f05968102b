#include "mesh/dual_graph.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "core/random.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

std::vector<uint32_t> row(const DualGraph& graph, uint32_t face) {
  const auto neighbours = graph.neighboursOf(face);
  return {neighbours.begin(), neighbours.end()};
}

bool hasEdge(const Face& face, uint32_t p, uint32_t q) {
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      if (i != j && face[i] == p && face[j] == q) return true;
  return false;
}

bool runs(const Face& face, uint32_t from, uint32_t to) {
  for (size_t i = 0; i < 3; ++i)
    if (face[i] == from && face[(i + 1) % 3] == to) return true;
  return false;
}

/// Whether the faces around an edge are joined in pairs.
bool isPaired(const Mesh& mesh, uint32_t p, uint32_t q) {
  size_t upCount = 0, downCount = 0;
  for (const Face& face : mesh.faces) {
    if (!hasDistinctVertices(face) && hasEdge(face, p, q)) return false;
    upCount += runs(face, p, q) ? 1 : 0;
    downCount += runs(face, q, p) ? 1 : 0;
  }
  return upCount == downCount && upCount > 1;
}

// Every pair of faces and every pair of vertices, no sorting: for edges of at most kMaxFacesJoinedAllToAll faces.
// Without the edges whose faces are joined in pairs; pairCount: their number, #F.
std::vector<std::vector<uint32_t>> bruteForceRows(const Mesh& mesh, std::vector<size_t>& pairCount) {
  std::vector<std::vector<uint32_t>> rows(mesh.faces.size());
  pairCount.assign(mesh.faces.size(), 0);
  for (uint32_t p = 0; p < mesh.vertices.size(); ++p)
    for (uint32_t q = p + 1; q < mesh.vertices.size(); ++q) {
      const bool isInPairs = isPaired(mesh, p, q);
      for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
        if (!hasEdge(mesh.faces[f], p, q)) continue;
        pairCount[f] += isInPairs ? 1 : 0;
        for (uint32_t g = 0; !isInPairs && g < mesh.faceCount(); ++g)
          if (f != g && hasEdge(mesh.faces[g], p, q)) rows[f].push_back(g);
      }
    }
  for (std::vector<uint32_t>& each : rows) std::sort(each.begin(), each.end());
  return rows;
}

}  // namespace

TEST_CASE("the dual of an empty mesh has no node") {
  const DualGraph graph = buildDualGraph({});
  CHECK(graph.faceCount() == 0);
  CHECK(graph.neighbours.empty());
}

TEST_CASE("a single face has no neighbour") {
  const DualGraph graph = buildDualGraph(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}});
  CHECK(graph.faceCount() == 1);
  CHECK(graph.neighbours.empty());
}

TEST_CASE("in a tetrahedron every face neighbours the other three") {
  const DualGraph graph = buildDualGraph(shapes::tetrahedron());
  CHECK(row(graph, 0) == std::vector<uint32_t>{1, 2, 3});
  CHECK(row(graph, 1) == std::vector<uint32_t>{0, 2, 3});
  CHECK(row(graph, 2) == std::vector<uint32_t>{0, 1, 3});
  CHECK(row(graph, 3) == std::vector<uint32_t>{0, 1, 2});
}

TEST_CASE("in a cube every face has the other half of its side and two faces of other sides") {
  const DualGraph graph = buildDualGraph(shapes::cube());
  CHECK(graph.neighbours.size() == 36);
  for (uint32_t f = 0; f < 12; ++f) {
    REQUIRE(row(graph, f).size() == 3);
    const auto neighbours = row(graph, f);
    CHECK(std::count(neighbours.begin(), neighbours.end(), f ^ 1u) == 1);
  }
}

TEST_CASE("an open grid has an arc pair per inner edge and none at its border") {
  const DualGraph graph = buildDualGraph(shapes::grid(7));
  const size_t innerEdgeCount = 7 * 7 + 2 * 7 * 6;  // Diagonals, then walls between squares.
  CHECK(graph.neighbours.size() == 2 * innerEdgeCount);
  CHECK(row(graph, 0) == std::vector<uint32_t>{1});
}

TEST_CASE("the pages of a book all neighbour each other") {
  for (uint32_t pageCount : {3u, 4u, kMaxFacesJoinedAllToAll}) {
    const DualGraph graph = buildDualGraph(shapes::book(pageCount));
    for (uint32_t f = 0; f < pageCount; ++f) {
      std::vector<uint32_t> others;
      for (uint32_t g = 0; g < pageCount; ++g)
        if (g != f) others.push_back(g);
      CHECK(row(graph, f) == others);
    }
  }
}

TEST_CASE("the pages of a book of a hundred are a chain") {
  for (uint32_t pageCount : {kMaxFacesJoinedAllToAll + 1, 100u}) {
    const DualGraph graph = buildDualGraph(shapes::book(pageCount));
    CHECK(graph.neighbours.size() == 2 * (pageCount - 1));
    CHECK(row(graph, 0) == std::vector<uint32_t>{1});
    CHECK(row(graph, 17) == std::vector<uint32_t>{16, 18});
    CHECK(row(graph, pageCount - 1) == std::vector<uint32_t>{pageCount - 2});
  }
}

TEST_CASE("duplicate faces share three edges and have three arcs") {
  const DualGraph graph = buildDualGraph(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}, {}});
  CHECK(row(graph, 0) == std::vector<uint32_t>{1, 1, 1});
  CHECK(row(graph, 1) == std::vector<uint32_t>{0, 0, 0});
}

TEST_CASE("a face with a repeated vertex joins over its one edge and never itself") {
  for (const Face& collapsed : {Face{0, 0, 1}, Face{0, 1, 0}, Face{1, 0, 0}, Face{1, 1, 0}}) {
    CAPTURE(collapsed[0]);
    const DualGraph graph =
        buildDualGraph(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, collapsed, {2, 2, 2}}, {}});
    CHECK(row(graph, 0) == std::vector<uint32_t>{1});
    CHECK(row(graph, 1) == std::vector<uint32_t>{0});
    CHECK(row(graph, 2).empty());
  }
}

TEST_CASE("a face with a non-finite corner joins nothing") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mesh mesh = shapes::tetrahedron();
    mesh.vertices[0].y = bad;
    CHECK(buildDualGraph(mesh).neighbours.empty());
    CHECK(row(buildDualGraph(shapes::joined(mesh, shapes::tetrahedron())), 4) == std::vector<uint32_t>{5, 6, 7});
  }
}

TEST_CASE("the dual graph of random soups equals that by comparison of all faces") {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const uint32_t vertexCount = 4 + static_cast<uint32_t>(seed % 9);
    const Mesh mesh = shapes::randomFaces(vertexCount, vertexCount * 3, seed);
    std::vector<size_t> pairCount;
    const auto rows = bruteForceRows(mesh, pairCount);
    const DualGraph graph = buildDualGraph(mesh);
    for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
      const std::vector<uint32_t> found = row(graph, f);
      REQUIRE(found.size() == rows[f].size() + pairCount[f]);
      REQUIRE(std::includes(found.begin(), found.end(), rows[f].begin(), rows[f].end()));
    }
  }
}

TEST_CASE("the edge kinds of a random soup equal those by comparison of all faces") {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const Mesh mesh = shapes::randomFaces(5 + static_cast<uint32_t>(seed % 9), 12, seed);
    const EdgeSurvey survey = surveyEdges(mesh);
    REQUIRE(survey.edgeKinds.size() == 3 * mesh.faces.size());
    double boundaryCount = 0, inconsistentCount = 0, branchingCount = 0,
           nonManifoldCount = 0;  // Shares of an edge, one per face.
    for (uint32_t f = 0; f < mesh.faceCount(); ++f)
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t from = mesh.faces[f][i], to = mesh.faces[f][(i + 1) % 3];
        uint32_t sameCount = 0, oppositeCount = 0;
        for (const Face& other : mesh.faces)
          for (size_t j = 0; hasDistinctVertices(other) && j < 3; ++j) {
            sameCount += other[j] == from && other[(j + 1) % 3] == to ? 1 : 0;
            oppositeCount += other[j] == to && other[(j + 1) % 3] == from ? 1 : 0;
          }
        const uint32_t count = sameCount + oppositeCount;
        EdgeKind expected = EdgeKind::Regular;
        if (hasDistinctVertices(mesh.faces[f])) {
          if (count == 1) expected = EdgeKind::Boundary;
          if (count % 2 == 0 && sameCount != oppositeCount) expected = EdgeKind::Inconsistent;
          if (count > 2 && count % 2 == 1) expected = EdgeKind::Branching;
        }
        REQUIRE(survey.edgeKinds[3 * f + i] == expected);
        boundaryCount += expected == EdgeKind::Boundary ? 1 : 0;
        inconsistentCount += expected == EdgeKind::Inconsistent ? 1.0 / count : 0;
        branchingCount += expected == EdgeKind::Branching ? 1.0 / count : 0;
        nonManifoldCount += hasDistinctVertices(mesh.faces[f]) && count > 2 ? 1.0 / count : 0;
      }
    const auto countOf = [&](EdgeKind kind) { return static_cast<double>(survey.countOf(kind)); };
    CHECK(countOf(EdgeKind::Boundary) == boundaryCount);
    CHECK(countOf(EdgeKind::Inconsistent) == doctest::Approx(inconsistentCount));
    CHECK(countOf(EdgeKind::Branching) == doctest::Approx(branchingCount));
    CHECK(static_cast<double>(survey.nonManifoldEdgeCount) == doctest::Approx(nonManifoldCount));
  }
}

TEST_CASE("the dual graph does not depend on the number of threads") {
  Mesh mesh = shapes::sphere(6);
  Random random(5);
  random.shuffle(std::span<Face>(mesh.faces));
  const DualGraph parallel = buildDualGraph(mesh);
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const DualGraph sequential = buildDualGraph(mesh);
  CHECK(parallel.offsets == sequential.offsets);
  CHECK(parallel.neighbours == sequential.neighbours);
}

TEST_CASE("a fan of 200,000 faces around one vertex is a chain of them") {
  for (const bool apexFirst : {true, false}) {
    const uint32_t faceCount = 200000;
    const DualGraph graph = buildDualGraph(shapes::fan(faceCount, apexFirst));
    CHECK(graph.neighbours.size() == 2 * (faceCount - 1));
    uint32_t wrongRowCount = 0;
    for (uint32_t f = 1; f + 1 < faceCount; ++f)
      if (row(graph, f) != std::vector<uint32_t>{f - 1, f + 1}) ++wrongRowCount;
    CHECK(wrongRowCount == 0);
  }
}
