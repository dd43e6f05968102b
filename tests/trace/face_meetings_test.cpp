#include "trace/face_meetings.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <stop_token>
#include <utility>
#include <vector>

#include "mesh/components.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

FaceMeetings meetingsOf(const Mesh& mesh) {
  const TracedMesh traced(mesh);
  const EdgeSurvey edges = surveyEdges(mesh);
  const std::vector<uint8_t> isWanted(mesh.faces.size(), 1);
  return findFaceMeetings(traced.scene(), edges.graph, findComponents(mesh, edges).componentOf, isWanted, {});
}

std::vector<uint8_t> facesWith(uint8_t bit, const Mesh& mesh) {
  std::vector<uint8_t> result = meetingsOf(mesh).bits;
  for (uint8_t& bits : result) bits = (bits & bit) != 0 ? 1 : 0;
  return result;
}

std::ptrdiff_t countWith(uint8_t bit, const Mesh& mesh) {
  const std::vector<uint8_t> found = facesWith(bit, mesh);
  return std::count(found.begin(), found.end(), 1);
}

std::ptrdiff_t crossedCount(const Mesh& mesh) { return countWith(kCrossed, mesh); }

/// Whether the segment passes through the triangle, by the signs of volumes.
bool passesThrough(const Vec3d& p, const Vec3d& q, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto isPositive = [](const Vec3d& i, const Vec3d& j, const Vec3d& k, const Vec3d& l) {
    return dot(cross(j - i, k - i), l - i) > 0;
  };
  if (isPositive(a, b, c, p) == isPositive(a, b, c, q)) return false;
  const bool side = isPositive(p, q, a, b);
  return isPositive(p, q, b, c) == side && isPositive(p, q, c, a) == side;
}

bool crossByBruteForce(const Mesh& mesh, const Face& face, const Face& other) {
  const auto at = [&](const Face& f, size_t k) { return mesh.vertices[f[k % 3]]; };
  for (size_t k = 0; k < 3; ++k)
    if (passesThrough(at(face, k), at(face, k + 1), at(other, 0), at(other, 1), at(other, 2)) ||
        passesThrough(at(other, k), at(other, k + 1), at(face, 0), at(face, 1), at(face, 2)))
      return true;
  return false;
}

}  // namespace

TEST_CASE("crossed faces are those of brute force") {
  for (const uint64_t seed : {1, 2, 3}) {
    Mesh mesh = shapes::soup(150, seed);
    for (Face& face : mesh.faces)  // Smaller, so that some cross none.
      for (size_t k = 1; k < 3; ++k)
        mesh.vertices[face[k]] = mesh.vertices[face[0]] + 0.7 * (mesh.vertices[face[k]] - mesh.vertices[face[0]]);
    std::vector<uint8_t> expected(mesh.faces.size());
    for (size_t i = 0; i < expected.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (crossByBruteForce(mesh, mesh.faces[i], mesh.faces[j])) expected[i] = expected[j] = 1;
    CHECK(facesWith(kCrossed, mesh) == expected);
    CHECK(std::count(expected.begin(), expected.end(), 1) > 20);
    CHECK(std::count(expected.begin(), expected.end(), 0) > 20);
  }
}

TEST_CASE("a pin through a plate: both sides of the plate and all sides of the pin are crossed, the ends are not") {
  const Mesh plate = shapes::box({4, 4, 1}), pin = shapes::box({1, 1, 5});
  const Mesh mesh = shapes::joined(plate, pin, {0.05, 0.1, 0.03});
  const TracedMesh traced(mesh);
  const std::vector<uint8_t> crossed = facesWith(kCrossed, mesh);
  for (uint32_t face = 0; face < crossed.size(); ++face) {
    CAPTURE(face);
    const bool isHorizontal = std::abs(traced.geometry.normals[face].z) > 0.5, isOfPlate = face < plate.faces.size();
    CHECK(crossed[face] == (isHorizontal == isOfPlate ? 1 : 0));
  }
  const Mesh apart = shapes::joined(plate, pin, {4, 0, 0});
  CHECK(crossedCount(apart) == 0);
}

TEST_CASE("parts that touch over an area touch, also if they sink into each other by less than a contact") {
  const Mesh table = shapes::box({6, 6, 1}), cube = shapes::box({1, 1, 1}), wide = shapes::box({6, 6, 1}, 3);
  for (const double gap : {0.0, 0x1p-21, -0x1p-21}) {  // The contact is 2^-20 of half the size of 6.
    CAPTURE(gap);
    const Mesh onIt = shapes::joined(table, cube, {0.3, 0.2, 1 + gap});
    const FaceMeetings meetings = meetingsOf(onIt);
    CHECK(countWith(kTouched, onIt) >= 3);
    CHECK(meetings.components == std::vector<std::pair<uint32_t, uint32_t>>{{0, 1}});
    // The outline of the cube cuts the top of the table: two of its sides for each of both triangles, and the diagonal.
    CHECK(meetings.cuts.size() >= 4);
    for (const FaceCut& cut : meetings.cuts) {
      CHECK(cut.face < table.faces.size());
      CHECK(cut.from.z == doctest::Approx(cut.to.z).epsilon(1e-5));
    }
    CHECK(countWith(kTouched, shapes::joined(table, wide, {0, 0, 1 + gap})) >= 2 + 18);  // Coplanar triangles.
  }
  CHECK(crossedCount(shapes::joined(table, cube, {0.3, 0.2, 1 - 1e-4})) > 0);
  const Mesh apart = shapes::joined(table, cube, {0.3, 0.2, 1 + 1e-4});
  CHECK(countWith(kCrossed | kTouched, apart) == 0);
}

TEST_CASE("crossings through edges and vertices are found") {
  // A wall through the diagonals of two sides of a box, and its edges through the edges of the box.
  const Mesh box = shapes::box({2, 2, 2});
  Mesh wall{{{-2, -2, -3}, {2, 2, -3}, {2, 2, 3}, {-2, -2, 3}}, {{0, 1, 2}, {0, 2, 3}}, {}};
  const Mesh mesh = shapes::joined(box, wall);
  CHECK(meetingsOf(mesh).bits.at(12) == kCrossed);
  CHECK(meetingsOf(mesh).bits.at(13) == kCrossed);
  CHECK(crossedCount(mesh) >= 2 + 4);
  const Mesh bow{{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, {4, 4, 1}, {4, 0, 1}, {0, 4, 1}},
                 {{0, 1, 5}, {0, 5, 4}, {2, 3, 7}, {2, 7, 6}},
                 {}};
  CHECK(crossedCount(bow) == 4);
  CHECK(meetingsOf(bow).cuts.size() >= 4);
}

TEST_CASE("faces that share a point may cross, faces that share an edge do not, by vertices or by positions") {
  // The second face passes through the first one, on both sides of the common tip.
  const std::vector<Vec3d> vertices{{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {1, 0, 1}, {1, 0, -1}};
  const Mesh shared{vertices, {{0, 1, 2}, {0, 3, 4}}, {}};
  CHECK(crossedCount(shared) == 2);
  Mesh apart = shared;
  apart.vertices.push_back({0, 0, 0});
  apart.faces[1][0] = 5;
  CHECK(crossedCount(apart) == 2);
  const Mesh folded{vertices, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}, {}};
  CHECK(crossedCount(folded) == 0);
  Mesh foldedApart = folded;
  foldedApart.vertices.push_back({0, 0, 0});
  foldedApart.faces[1][0] = 5;
  CHECK(crossedCount(foldedApart) == 0);
  for (const Mesh& mesh : {shapes::cube(), shapes::sphere(3), shapes::fan(50, true), shapes::book(9), shapes::grid(4)})
    CHECK(crossedCount(mesh) == 0);
}

TEST_CASE("faces that are folded onto each other touch") {
  const Mesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}, {}};
  CHECK(countWith(kTouched, sheet) == 4);
  CHECK(countWith(kTouched, shapes::grid(3)) == 0);
}

TEST_CASE("a stop request ends the search") {
  const TracedMesh traced(shapes::soup(50, 1));
  std::stop_source stop;
  stop.request_stop();
  const std::vector<uint32_t> componentOf(traced.mesh.faceCount());
  const std::vector<uint8_t> isWanted(traced.mesh.faceCount(), 1);
  const DualGraph graph = buildDualGraph(traced.mesh);
  test::requireFailure(
      [&] {
        (void)findFaceMeetings(traced.scene(), graph, componentOf, isWanted, {stop.get_token(), {}});
      },
      ErrorCode::Cancelled);
}
