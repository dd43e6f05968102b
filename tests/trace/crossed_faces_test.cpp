#include "trace/crossed_faces.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <stop_token>
#include <vector>

#include "support/require_failure.h"
#include "support/shapes.h"
#include "trace/wall_tree.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

std::vector<uint8_t> crossedFaces(const TracedMesh& traced) {
  std::vector<uint32_t> solidOf(traced.mesh.faceCount());  // Each face is a solid of its own.
  std::iota(solidOf.begin(), solidOf.end(), 0u);
  return findCrossedFaces(traced.scene(), solidOf, kContactDistance, {});
}

std::ptrdiff_t crossedCount(const Mesh& mesh) {
  const std::vector<uint8_t> crossed = crossedFaces(TracedMesh(mesh));
  return std::count(crossed.begin(), crossed.end(), 1);
}

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
    CHECK(crossedFaces(TracedMesh(mesh)) == expected);
    CHECK(std::count(expected.begin(), expected.end(), 1) > 20);
    CHECK(std::count(expected.begin(), expected.end(), 0) > 20);
  }
}

TEST_CASE("a pin through a plate: both sides of the plate and all sides of the pin are crossed, the ends are not") {
  const Mesh plate = shapes::box({4, 4, 1}), pin = shapes::box({1, 1, 5});
  const Mesh mesh = shapes::joined(plate, pin, {0.05, 0.1, 0.03});
  const TracedMesh traced(mesh);
  const std::vector<uint8_t> crossed = crossedFaces(traced);
  for (uint32_t face = 0; face < crossed.size(); ++face) {
    CAPTURE(face);
    const bool isHorizontal = std::abs(traced.geometry.normals[face].z) > 0.5, isOfPlate = face < plate.faces.size();
    CHECK(crossed[face] == (isHorizontal == isOfPlate ? 1 : 0));
  }
  const Mesh apart = shapes::joined(plate, pin, {4, 0, 0});
  CHECK(crossedCount(apart) == 0);
}

TEST_CASE("parts that touch, and parts that sink into each other by less than a contact, do not cross") {
  const Mesh table = shapes::box({6, 6, 1}), cube = shapes::box({1, 1, 1}), wide = shapes::box({6, 6, 1}, 3);
  for (const double gap : {0.0, 0x1p-21, -0x1p-21}) {  // The contact is 2^-20 of half the size of 6.
    CAPTURE(gap);
    CHECK(crossedCount(shapes::joined(table, cube, {0.3, 0.2, 1 + gap})) == 0);  // On it.
    CHECK(crossedCount(shapes::joined(table, cube, {3.5 + gap, 0.2, 0})) == 0);  // Beside it.
    CHECK(crossedCount(shapes::joined(table, wide, {0, 0, 1 + gap})) == 0);      // Coplanar triangles that overlap.
    CHECK(crossedCount(shapes::joined(table, cube, {3.5 + gap, 3.5, 1})) == 0);  // At a corner.
  }
  CHECK(crossedCount(shapes::joined(table, cube, {0.3, 0.2, 1 - 1e-4})) > 0);
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

TEST_CASE("crossings within a solid and between solids are told apart") {
  const Mesh plate = shapes::box({4, 4, 1}), pin = shapes::box({1, 1, 5});
  const TracedMesh traced(shapes::joined(plate, pin, {0.05, 0.1, 0.03}));
  std::vector<uint32_t> solidOf(traced.mesh.faceCount());
  const auto bitsOf = [&] {
    uint8_t bits = 0;
    for (const uint8_t each : findCrossedFaces(traced.scene(), solidOf, kContactDistance, {})) bits |= each;
    return bits;
  };
  CHECK(bitsOf() == kCrossedBySame);
  std::fill(solidOf.begin() + static_cast<std::ptrdiff_t>(plate.faces.size()), solidOf.end(), 1u);
  CHECK(bitsOf() == kCrossedByOther);
}

TEST_CASE("a stop request ends the search") {
  const TracedMesh traced(shapes::soup(50, 1));
  std::stop_source stop;
  stop.request_stop();
  test::requireFailure(
      [&] {
        (void)findCrossedFaces(traced.scene(), std::vector<uint32_t>(traced.mesh.faceCount()), kContactDistance,
                               {stop.get_token(), {}});
      },
      ErrorCode::Cancelled);
}
