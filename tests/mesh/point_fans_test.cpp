#include "mesh/point_fans.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "generate/solids.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

/// The corners at the position of a vertex, ascending.
std::vector<uint32_t> cornersByPosition(const Mesh& mesh, const Vec3d& position) {
  std::vector<uint32_t> corners;
  for (uint32_t corner = 0; corner < 3 * mesh.faces.size(); ++corner)
    if (mesh.vertices[mesh.faces[corner / 3][corner % 3]] == position) corners.push_back(corner);
  return corners;
}

void checkFans(const Mesh& mesh) {
  CAPTURE(mesh.faces.size());
  const PointFans fans(mesh);
  REQUIRE(fans.vertexCount() == mesh.vertices.size());
  for (uint32_t vertex = 0; vertex < fans.vertexCount(); ++vertex) {
    const Vec3d& position = mesh.vertices[vertex];
    const auto lowest = std::find(mesh.vertices.begin(), mesh.vertices.end(), position);
    CHECK(fans.pointOf(vertex) == static_cast<uint32_t>(lowest - mesh.vertices.begin()));
    const auto corners = fans.cornersAt(vertex);
    const std::vector<uint32_t> expected =
        fans.pointOf(vertex) == vertex ? cornersByPosition(mesh, position) : std::vector<uint32_t>{};
    CHECK(std::equal(corners.begin(), corners.end(), expected.begin(), expected.end()));
  }
}

}  // namespace

TEST_CASE("a point has the corners of all faces at its position, ascending") {
  for (const Mesh& mesh : {shapes::cube(), shapes::sphere(2), shapes::fan(300, true), shapes::fan(300, false),
                           shapes::boxesWithSharedEdge(), shapes::randomFaces(20, 100, 3)})
    for (const Mesh& each : {mesh, solids::separated(mesh), shapes::joined(mesh, mesh)}) checkFans(each);
}

TEST_CASE("zeros of both signs are one coordinate, and a vertex of no face has no corner") {
  const Mesh mesh{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {-1, 0, 0}, {5, 5, 5}}, {{0, 1, 2}, {3, 2, 4}}, {}};
  const PointFans fans(mesh);
  CHECK(fans.pointOf(3) == 0);
  REQUIRE(fans.cornersAt(0).size() == 2);
  CHECK(fans.cornersAt(0)[1] == 3);
  CHECK(fans.cornersAt(3).empty());
  CHECK(fans.cornersAt(5).empty());
}

TEST_CASE("vertices that are not finite are points of their own") {
  Mesh mesh = shapes::cube();
  mesh.vertices[1].x = mesh.vertices[6].x = std::nan("");
  const PointFans fans(mesh);
  for (uint32_t vertex = 0; vertex < 8; ++vertex) {
    CHECK(fans.pointOf(vertex) == vertex);
    CHECK_FALSE(fans.cornersAt(vertex).empty());
  }
}
