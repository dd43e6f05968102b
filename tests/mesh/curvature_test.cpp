#include "mesh/curvature.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh/arc_angles.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

double sumOfDefects(const Mesh& mesh) {
  const std::vector<double> defects = vertexAngleDefects(mesh);
  return std::accumulate(defects.begin(), defects.end(), 0.0);
}

/// Per arc.
std::vector<double> anglesOf(const Mesh& mesh) {
  const DualGraph graph = buildDualGraph(mesh);
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  std::vector<double> angles;
  for (uint32_t f = 0; f < graph.faceCount(); ++f)
    for (const uint32_t g : graph.neighboursOf(f)) angles.push_back(signedDihedralAngle(geometry, f, g));
  return angles;
}

/// Two faces at the edge along x; the second rises by `angle` from the plane of the first.
Mesh folded(double angle) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, -1, 0}, {0.5, std::cos(angle), std::sin(angle)}};
  mesh.faces = {{0, 2, 1}, {0, 1, 3}};
  return mesh;
}

}  // namespace

TEST_CASE("each corner of a cube has the angle defect pi/2 at any scale") {
  for (const double scale : {1e-150, 1e-30, 1.0, 1e3, 1e30, 1e150}) {
    for (const double defect : vertexAngleDefects(shapes::scaledAndShifted(shapes::cube(), scale)))
      CHECK(defect == doctest::Approx(std::numbers::pi / 2));
  }
  for (const double curvature : faceCurvature(shapes::cube()))
    CHECK(curvature == doctest::Approx(std::numbers::pi / 2));
}

TEST_CASE("angle defects of closed meshes sum to 2 pi times the Euler characteristic") {
  CHECK(sumOfDefects(shapes::tetrahedron()) == doctest::Approx(4 * std::numbers::pi));
  CHECK(sumOfDefects(shapes::sphere(4)) == doctest::Approx(4 * std::numbers::pi));
  CHECK(sumOfDefects(shapes::torus(3, 1, 40, 20)) == doctest::Approx(0).epsilon(1e-9));
  CHECK(sumOfDefects(shapes::joined(shapes::cube(), shapes::scaledAndShifted(shapes::cube(), 1, {5, 0, 0}))) ==
        doctest::Approx(8 * std::numbers::pi));
}

TEST_CASE("a disk's defects sum to 2 pi, all of them at its corners when it is flat") {
  const Mesh mesh = shapes::grid(5);
  const std::vector<double> defects = vertexAngleDefects(mesh);
  CHECK(sumOfDefects(mesh) == doctest::Approx(2 * std::numbers::pi));
  CHECK(defects[0] == doctest::Approx(std::numbers::pi / 2));
  CHECK(std::abs(defects[2]) < 1e-12);  // On the border, not at a corner.
  CHECK(std::abs(defects[8]) < 1e-12);  // Inside.
  const std::vector<double> curvature = faceCurvature(mesh);
  CHECK(curvature[0] == doctest::Approx(std::numbers::pi / 6));
  CHECK(std::abs(curvature[24]) < 1e-12);
}

TEST_CASE("faces of zero area keep the sum of the defects") {
  SUBCASE("corners in line") {
    Mesh mesh = shapes::tetrahedron();  // A vertex in the middle of an edge, split on one side only.
    mesh.vertices.push_back((mesh.vertices[0] + mesh.vertices[1]) / 2.0);
    mesh.faces = {{0, 2, 4}, {4, 2, 1}, {0, 4, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    CHECK(sumOfDefects(mesh) == doctest::Approx(4 * std::numbers::pi));
  }
  SUBCASE("two corners at one place") {
    Mesh mesh = shapes::cube();
    mesh.vertices[1] = mesh.vertices[0];
    CHECK(sumOfDefects(mesh) == doctest::Approx(4 * std::numbers::pi));
  }
  SUBCASE("all corners at one place") {
    Mesh mesh = shapes::cube();
    mesh.vertices[2] = mesh.vertices[3] = mesh.vertices[0];
    CHECK(sumOfDefects(mesh) == doctest::Approx(4 * std::numbers::pi));
  }
}

TEST_CASE("repeated vertices, non-finite corners and lone vertices leave finite curvature") {
  Mesh mesh = shapes::joined(shapes::cube(), shapes::tetrahedron());
  mesh.vertices.push_back({9, 9, 9});
  mesh.vertices[8].x = std::numeric_limits<double>::quiet_NaN();
  mesh.faces.push_back({0, 0, 1});
  const std::vector<double> defects = vertexAngleDefects(mesh);
  CHECK(defects[0] == doctest::Approx(std::numbers::pi / 2));
  CHECK(defects[8] == 0);
  // Vertex 9 is a border vertex of one finite face.
  CHECK(defects[9] == doctest::Approx(std::numbers::pi - std::numbers::pi / 3));
  CHECK(defects[12] == 0);
  for (const double curvature : faceCurvature(mesh)) CHECK(std::isfinite(curvature));
}

TEST_CASE("a face that rises is a concave edge, one that falls a convex one, by their exact angle") {
  for (double angle : {1e-9, 1e-4, 0.1, 1.5, 3.0}) {
    CAPTURE(angle);
    const std::vector<double> rising = anglesOf(folded(angle)), falling = anglesOf(folded(-angle));
    REQUIRE(rising.size() == 2);
    for (size_t arc = 0; arc < 2; ++arc) {
      CHECK(rising[arc] == doctest::Approx(angle).epsilon(1e-6));
      CHECK(falling[arc] == doctest::Approx(-angle).epsilon(1e-6));
    }
  }
}

TEST_CASE("a cube is convex at its edges, flat at its diagonals, and concave from within") {
  for (double sign : {-1.0, 1.0}) {
    const std::vector<double> angles = anglesOf(sign < 0 ? shapes::cube() : shapes::inverted(shapes::cube()));
    REQUIRE(angles.size() == 36);
    size_t foldedCount = 0, flatCount = 0;
    for (double angle : angles) {
      foldedCount += std::abs(angle - sign * std::numbers::pi / 2) < 1e-12 ? 1 : 0;
      flatCount += std::abs(angle) < 1e-12 ? 1 : 0;
    }
    CHECK(foldedCount == 24);
    CHECK(flatCount == 12);
  }
}

TEST_CASE("a ring is concave on its inner side only") {
  const Mesh mesh = shapes::torus(4, 1, 12, 12);
  const DualGraph graph = buildDualGraph(mesh);
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  const std::vector<double> angles = anglesOf(mesh);
  size_t concaveCount = 0;
  for (uint32_t f = 0; f < graph.faceCount(); ++f)
    for (uint32_t arc = graph.offsets[f]; arc < graph.offsets[f + 1]; ++arc) {
      if (angles[arc] < 1e-6) continue;
      ++concaveCount;
      CHECK(std::hypot(geometry.barycentres[f].x, geometry.barycentres[f].y) < 4);
    }
  // A third of the 432 arcs there lead across a meridian.
  CHECK(concaveCount > 100);
}

TEST_CASE("faces oriented against each other are not concave") {
  Mesh mesh = folded(0.2);
  std::swap(mesh.faces[1][0], mesh.faces[1][1]);
  for (double angle : anglesOf(mesh)) CHECK(angle == doctest::Approx(-(std::numbers::pi - 0.2)));
}

TEST_CASE("an edge at a degenerate face has no angle") {
  Mesh mesh = folded(0.2);
  mesh.vertices[3] = {0.5, 0, 0};
  CHECK(anglesOf(mesh) == std::vector<double>{0, 0});
}

TEST_CASE("angles do not depend on the unit") {
  const Mesh mesh = shapes::torus(4, 1, 12, 12);
  const std::vector<double> expected = anglesOf(mesh);
  for (double unit : {0x1p-400, 0x1p400}) {
    const std::vector<double> angles = anglesOf(shapes::scaledAndShifted(mesh, unit));
    REQUIRE(angles.size() == expected.size());
    for (size_t arc = 0; arc < angles.size(); ++arc) CHECK(angles[arc] == doctest::Approx(expected[arc]));
  }
}

TEST_CASE("both directions of an arc have the same bits, whatever the input") {
  for (uint64_t seed : {1, 2, 3}) {
    const Mesh mesh = shapes::randomFaces(40, 300, seed);
    const DualGraph graph = buildDualGraph(mesh);
    const std::vector<double> angles = anglesOf(mesh);
    for (uint32_t f = 0; f < graph.faceCount(); ++f)
      for (uint32_t arc = graph.offsets[f]; arc < graph.offsets[f + 1]; ++arc) {
        const uint32_t g = graph.neighbours[arc];
        const auto back = std::lower_bound(graph.neighbours.begin() + graph.offsets[g],
                                           graph.neighbours.begin() + graph.offsets[g + 1], f);
        REQUIRE(*back == f);
        REQUIRE(angles[arc] == angles[static_cast<size_t>(back - graph.neighbours.begin())]);
        REQUIRE(std::abs(angles[arc]) <= std::numbers::pi);
      }
  }
}
