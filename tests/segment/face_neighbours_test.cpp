#include "segment/face_neighbours.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "generate/shapes.h"
#include "mesh/dual_graph.h"

using namespace asdfvk;

namespace {

constexpr uint32_t kNone = kNoNeighbour;
using Row = std::array<uint32_t, 3>;

}  // namespace

TEST_CASE("a neighbour stands at the corner where the common edge begins") {
  const Mesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}};
  CHECK(findFaceNeighbours(square) == FaceNeighbours{Row{kNone, kNone, 1}, Row{0, kNone, kNone}});
}

TEST_CASE("no face, one face, and two faces with three common edges") {
  CHECK(findFaceNeighbours(Mesh{}).empty());
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  CHECK(findFaceNeighbours(mesh) == FaceNeighbours{Row{kNone, kNone, kNone}});
  mesh.faces.push_back({2, 1, 0});
  CHECK(findFaceNeighbours(mesh) == FaceNeighbours{Row{1, 1, 1}, Row{0, 0, 0}});
}

TEST_CASE("faces of opposite winding, of edges with three faces, and broken faces have no neighbour there") {
  const std::vector<Vec3d> vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, NAN, 0}};
  const Row none{kNone, kNone, kNone};
  CHECK(findFaceNeighbours(Mesh{vertices, {{0, 1, 2}, {2, 0, 3}}, {}}) == FaceNeighbours{none, none});
  CHECK(findFaceNeighbours(Mesh{vertices, {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}}, {}}) == FaceNeighbours{none, none, none});
  CHECK(findFaceNeighbours(Mesh{vertices, {{0, 1, 2}, {2, 3, 0}}, {}})[0] == Row{kNone, kNone, 1});
  CHECK(findFaceNeighbours(Mesh{vertices, {{0, 1, 2}, {0, 2, 3}, {3, 3, 2}}, {}}) ==
        FaceNeighbours{Row{kNone, kNone, 1}, Row{0, kNone, kNone}, none});
  CHECK(findFaceNeighbours(Mesh{vertices, {{0, 1, 2}, {1, 0, 5}}, {}}) == FaceNeighbours{none, none});
}

TEST_CASE("an edge where two closed surfaces touch joins the faces of each") {
  // Two tetrahedra with the common edge 0-1.
  const std::vector<Vec3d> vertices{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  const Mesh both{
      vertices, {{0, 2, 3}, {0, 1, 2}, {1, 0, 3}, {1, 3, 2}, {0, 4, 5}, {0, 1, 4}, {1, 0, 5}, {1, 5, 4}}, {}};
  const FaceNeighbours neighbours = findFaceNeighbours(both);
  CHECK(neighbours[1][0] == 2);
  CHECK(neighbours[2][0] == 1);
  CHECK(neighbours[5][0] == 6);
  CHECK(neighbours[6][0] == 5);
}

TEST_CASE("on a closed surface the neighbours are those of the dual graph") {
  const Mesh mesh = generateShape("torus", 2000).mesh;
  const DualGraph graph = buildDualGraph(mesh);
  const FaceNeighbours neighbours = findFaceNeighbours(mesh);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    Row row = neighbours[face];
    std::sort(row.begin(), row.end());
    REQUIRE(std::equal(row.begin(), row.end(), graph.neighboursOf(face).begin(), graph.neighboursOf(face).end()));
  }
}
