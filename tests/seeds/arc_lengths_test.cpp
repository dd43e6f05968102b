#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random.h"
#include "generate/shapes.h"
#include "mesh/arc_angles.h"
#include "seeds/surface.h"
#include "seeds/surface_distances.h"

using namespace asdfvk;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Two faces on the edge from (0, 0, 0) to (0, 1, 0), with upward normals when flat; the second is turned up by the
/// angle, which makes the edge concave.
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

TEST_CASE("angles of arcs are the dihedral angles rounded to float") {
  const auto differingCount = [](const Mesh& mesh) {
    const Surface surface(mesh);
    const UnsetVector<float> angles = arcAngles(surface.graph, surface.geometry);
    CHECK(arcAngles(surface.graph, surface.geometry, InstructionSet::Baseline) == angles);
    size_t count = 0, arc = 0;
    for (uint32_t face = 0; face < surface.graph.faceCount(); ++face)
      for (const uint32_t neighbour : surface.graph.neighboursOf(face))
        count += angles[arc++] != static_cast<float>(signedDihedralAngle(surface.geometry, face, neighbour));
    CHECK(arc > 0);
    return count;
  };
  size_t count = 0;
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const double degrees = i < 1000 ? 14 + 0.0001 * i : 16 * static_cast<double>(random.next() >> 32) * 0x1p-32;
    count += differingCount(book(degrees));
  }
  for (const std::string_view name : {"animal", "sphere", "cylinder", "cube"})
    count += differingCount(generateShape(name, 20'000).mesh);
  CHECK(count == 0);
}

TEST_CASE("an arc is 1 when flat, and sqrt 2 at 10 degrees concave and 20 convex, at any scale") {
  const auto lengthAt = [](double degrees) {
    const Surface surface(book(degrees));
    const UnsetVector<float> lengths = arcLengths(arcAngles(surface.graph, surface.geometry));
    REQUIRE(lengths.size() == 2);
    CHECK(lengths[0] == lengths[1]);
    for (double scale : {1e-12, 1e12}) {
      const Surface other(scaled(book(degrees), scale));
      for (float length : arcLengths(arcAngles(other.graph, other.geometry)))
        CHECK(length == doctest::Approx(lengths[0]));
    }
    return static_cast<double>(lengths[0]);
  };
  CHECK(lengthAt(0) == 1);
  CHECK(lengthAt(10) == doctest::Approx(std::sqrt(2)));
  CHECK(lengthAt(-20) == doctest::Approx(std::sqrt(2)));
  CHECK(lengthAt(90) == doctest::Approx(std::sqrt(82)));
  CHECK(lengthAt(-90) == doctest::Approx(std::sqrt(1 + 4.5 * 4.5)));
}

TEST_CASE("an arc to a degenerate face is 1, and every arc is within the limits") {
  Mesh mesh = book(60);
  mesh.vertices[3] = {0, 0.5, 0};
  const Surface squeezed(mesh);
  REQUIRE(squeezed.geometry.isDegenerate(1));
  CHECK(arcLengths(arcAngles(squeezed.graph, squeezed.geometry)) == UnsetVector<float>{1, 1});
  // The product of this normal with the zero normal of the degenerate face is -0.
  mesh.vertices = {{0, 0, 0}, {0, 1, -1}, {1, 0, -1}, {0, 0.5, -0.5}};
  const Surface turned(mesh);
  REQUIRE(turned.geometry.isDegenerate(1));
  for (size_t axis = 0; axis < 3; ++axis) REQUIRE(turned.geometry.normals[0][axis] < 0);
  CHECK(arcAngles(turned.graph, turned.geometry) == UnsetVector<float>{0, 0});
  CHECK(signedDihedralAngle(turned.geometry, 0, 1) == 0);
  CHECK(signedDihedralAngle(turned.geometry, 1, 0) == 0);

  const Surface folded(book(180));
  const Surface point([] {
    Mesh all = strip(4);
    for (Vec3d& vertex : all.vertices) vertex = {1, 1, 1};
    return all;
  }());
  for (const Surface* surface : {&folded, &point}) {
    for (float arc : arcLengths(arcAngles(surface->graph, surface->geometry))) {
      CHECK(arc >= kMinArcLength);
      CHECK(arc <= kMaxArcLength);
    }
  }
}

TEST_CASE("coordinates whose squares overflow or underflow leave every arc finite and positive") {
  for (double scale : {1e-300, 1e300}) {
    const Surface surface(scaled(strip(5), scale));
    for (float arc : arcLengths(arcAngles(surface.graph, surface.geometry))) CHECK((arc > 0 && arc <= kMaxArcLength));
  }
}

TEST_CASE("on a cube the arcs across its edges are long and the others are 1") {
  const Surface& cube = generatedSurface("cube", 1200);
  const UnsetVector<float> lengths = arcLengths(arcAngles(cube.graph, cube.geometry));
  const auto flat = std::count_if(lengths.begin(), lengths.end(), [](float arc) { return arc < 1.0001f; });
  const auto edge = std::count_if(lengths.begin(), lengths.end(),
                                  [](float arc) { return std::abs(arc - std::sqrt(1 + 4.5 * 4.5)) < 1e-4; });
  CHECK(edge > 100);
  CHECK(flat + edge == static_cast<std::ptrdiff_t>(lengths.size()));
}

TEST_CASE("both directions of an arc have the length of their angle, also where faces share edges more than once") {
  // Faces 0 and 1 share three edges, one of them with two further faces.
  Mesh mesh = book(25);
  mesh.vertices.push_back({2, 3, 1});
  mesh.faces = {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}, {1, 0, 4}};
  const Surface folded(mesh);
  for (const Surface* surface : {&folded, &generatedSurface("hand", 1000)}) {
    const UnsetVector<float> lengths = arcLengths(arcAngles(surface->graph, surface->geometry));
    for (uint32_t face = 0; face < surface->graph.faceCount(); ++face) {
      for (uint32_t arc = surface->graph.offsets[face]; arc < surface->graph.offsets[face + 1]; ++arc) {
        const double angle = signedDihedralAngle(surface->geometry, face, surface->graph.neighbours[arc]) / kDegree;
        const double bend = angle / (angle > 0 ? kConcaveAngleDegrees : kConvexAngleDegrees);
        CHECK(lengths[arc] == doctest::Approx(std::sqrt(1 + bend * bend)).epsilon(1e-6));
      }
    }
  }
}
