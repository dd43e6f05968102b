#include "mesh/curvature.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>
#include <numbers>
#include <numeric>

#include "shapes.h"

using namespace asdfvk;

namespace {

double sumOfDefects(const Mesh& mesh) {
  const std::vector<double> defects = vertexAngleDefects(mesh);
  return std::accumulate(defects.begin(), defects.end(), 0.0);
}

}  // namespace

TEST_CASE("each corner of a cube has the angle defect pi/2 at any scale") {
  for (const double scale : {1e-150, 1e-30, 1.0, 1e3, 1e30, 1e150}) {
    for (const double defect : vertexAngleDefects(shapes::placed(shapes::cube(), scale)))
      CHECK(defect == doctest::Approx(std::numbers::pi / 2));
  }
  for (const double curvature : faceCurvature(shapes::cube()))
    CHECK(curvature == doctest::Approx(std::numbers::pi / 2));
}

TEST_CASE("angle defects of closed meshes sum to 2 pi times the Euler characteristic") {
  CHECK(sumOfDefects(shapes::tetrahedron()) == doctest::Approx(4 * std::numbers::pi));
  CHECK(sumOfDefects(shapes::sphere(4)) == doctest::Approx(4 * std::numbers::pi));
  CHECK(sumOfDefects(shapes::torus(3, 1, 40, 20)) == doctest::Approx(0).epsilon(1e-9));
  CHECK(sumOfDefects(shapes::together(shapes::cube(), shapes::placed(shapes::cube(), 1, {5, 0, 0}))) ==
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
  Mesh mesh = shapes::together(shapes::cube(), shapes::tetrahedron());
  mesh.vertices.push_back({9, 9, 9});
  mesh.vertices[8].x = std::numeric_limits<double>::quiet_NaN();
  mesh.faces.push_back({0, 0, 1});
  const std::vector<double> defects = vertexAngleDefects(mesh);
  CHECK(defects[0] == doctest::Approx(std::numbers::pi / 2));
  CHECK(defects[8] == 0);
  CHECK(defects[9] ==
        doctest::Approx(std::numbers::pi - std::numbers::pi / 3));  // One finite face is left around it: its border.
  CHECK(defects[12] == 0);
  for (const double curvature : faceCurvature(mesh)) CHECK(std::isfinite(curvature));
}
