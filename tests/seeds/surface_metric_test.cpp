#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/dihedral.h"
#include "seeds/surface.h"
#include "seeds/surface_metric.h"

using namespace asdfvk;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Two faces on the edge from (0, 0, 0) to (0, 1, 0), both looking up when flat; the second is turned up by the angle,
/// so that their outward sides look at each other.
Mesh book(double angleDegrees) {
  const double angle = angleDegrees * kDegree;
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}, {std::cos(angle), 0.5, std::sin(angle)}};
  mesh.faces = {{0, 1, 2}, {0, 3, 1}};
  return mesh;
}

Mesh scaled(Mesh mesh, double scale) {
  for (Vec3d& vertex : mesh.vertices) vertex = vertex * scale;
  return mesh;
}

}  // namespace

TEST_CASE("the dihedral angle is 0 when flat, positive when concave, negative when convex, from both sides") {
  for (double degrees : {0.0, 0.001, 5.0, 10.0, 45.0, 90.0, 135.0, 179.0}) {
    for (double sign : {1.0, -1.0}) {
      CAPTURE(sign * degrees);
      const Surface surface(book(sign * degrees));
      REQUIRE(surface.geometry.normals[0].z == doctest::Approx(1));
      CHECK(signedDihedralAngle(surface.geometry, 0, 1) / kDegree == doctest::Approx(sign * degrees).epsilon(1e-9));
      CHECK(signedDihedralAngle(surface.geometry, 1, 0) / kDegree == doctest::Approx(sign * degrees).epsilon(1e-9));
    }
  }
}

TEST_CASE("an angle step is a hop when flat, and sqrt 2 hops at 10 degrees concave and 20 convex") {
  const auto stepAt = [](double degrees) {
    const Surface surface(book(degrees));
    const std::vector<float> lengths = arcLengths(surface.graph, surface.geometry, SurfaceMetric::Angle);
    REQUIRE(lengths.size() == 2);
    CHECK(lengths[0] == lengths[1]);
    return static_cast<double>(lengths[0]);
  };
  CHECK(stepAt(0) == 1);
  CHECK(stepAt(10) == doctest::Approx(std::sqrt(2)));
  CHECK(stepAt(-20) == doctest::Approx(std::sqrt(2)));
  CHECK(stepAt(90) == doctest::Approx(std::sqrt(82)));
  CHECK(stepAt(-90) == doctest::Approx(std::sqrt(1 + 4.5 * 4.5)));
}

TEST_CASE("a hop is 1 whatever the angle") {
  const Surface surface(book(70));
  CHECK(arcLengths(surface.graph, surface.geometry, SurfaceMetric::Hops) == std::vector<float>{1, 1});
}

TEST_CASE("lengths are in medians of the mesh, and no metric knows its unit") {
  // Faces of a strip are alike but for the last, which is drawn out to three times the step.
  Mesh mesh = strip(9);
  mesh.vertices.back().x += 3;
  const Surface surface(mesh);
  const std::vector<float> lengths = arcLengths(surface.graph, surface.geometry, SurfaceMetric::Length);
  REQUIRE(lengths.size() == 16);
  for (size_t arc = 0; arc < 14; ++arc) CHECK(lengths[arc] == doctest::Approx(1));
  const Vec3d lastStep = surface.geometry.barycentres[8] - surface.geometry.barycentres[7];
  const Vec3d firstStep = surface.geometry.barycentres[1] - surface.geometry.barycentres[0];
  CHECK(lengths[15] == doctest::Approx(length(lastStep) / length(firstStep)));
  CHECK(lengths[14] == lengths[15]);
  CHECK(lengths[15] > 2);

  for (SurfaceMetric metric : {SurfaceMetric::Hops, SurfaceMetric::Length, SurfaceMetric::Angle}) {
    const std::vector<float> reference = arcLengths(surface.graph, surface.geometry, metric);
    for (double scale : {1e-12, 1e12}) {
      const Surface other(scaled(mesh, scale));
      const std::vector<float> found = arcLengths(other.graph, other.geometry, metric);
      REQUIRE(found.size() == reference.size());
      for (size_t arc = 0; arc < found.size(); ++arc) CHECK(found[arc] == doctest::Approx(reference[arc]));
    }
  }
}

TEST_CASE("a degenerate face lies flat, and barycentres in one place are not in none") {
  Mesh mesh = book(60);
  mesh.vertices[3] = {0, 0.5, 0};
  const Surface squeezed(mesh);
  REQUIRE(squeezed.geometry.isDegenerate(1));
  CHECK(arcLengths(squeezed.graph, squeezed.geometry, SurfaceMetric::Angle) == std::vector<float>{1, 1});

  const Surface folded(book(180));
  const Surface point([] {
    Mesh all = strip(4);
    for (Vec3d& vertex : all.vertices) vertex = {1, 1, 1};
    return all;
  }());
  for (SurfaceMetric metric : {SurfaceMetric::Length, SurfaceMetric::Angle}) {
    for (const Surface* surface : {&folded, &point}) {
      for (float arc : arcLengths(surface->graph, surface->geometry, metric)) {
        CHECK(arc >= kShortestArc);
        CHECK(arc <= kLongestArc);
      }
    }
  }
}

TEST_CASE("coordinates beyond what a double can square leave every arc finite and positive") {
  for (double scale : {1e-300, 1e300}) {
    const Surface surface(scaled(strip(5), scale));
    for (SurfaceMetric metric : {SurfaceMetric::Hops, SurfaceMetric::Length, SurfaceMetric::Angle})
      for (float arc : arcLengths(surface.graph, surface.geometry, metric)) CHECK((arc > 0 && arc <= kLongestArc));
  }
}

TEST_CASE("on a closed surface a stretch is a matter of the edge: a cube is convex at its edges and flat elsewhere") {
  const Surface& cube = generatedSurface("cube", 1200);
  const std::vector<float> lengths = arcLengths(cube.graph, cube.geometry, SurfaceMetric::Angle);
  const auto flat = std::count_if(lengths.begin(), lengths.end(), [](float arc) { return arc < 1.0001f; });
  const auto edge = std::count_if(lengths.begin(), lengths.end(),
                                  [](float arc) { return std::abs(arc - std::sqrt(1 + 4.5 * 4.5)) < 1e-4; });
  CHECK(edge > 100);
  CHECK(flat + edge == static_cast<std::ptrdiff_t>(lengths.size()));
}
