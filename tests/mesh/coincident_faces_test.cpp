#include "mesh/coincident_faces.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "support/shapes.h"

using namespace asdfvk;

namespace {

std::vector<uint32_t> representativesOf(const Mesh& mesh) {
  const UnsetVector<uint32_t> representatives = coincidentRepresentatives(mesh, surveyEdges(mesh));
  return {representatives.begin(), representatives.end()};
}

}  // namespace

TEST_CASE("a third side of a pillow is a copy of one of the two, which are not copies of each other") {
  Mesh mesh = shapes::scaledAndShifted(shapes::cube(), 1, {5, 0, 0});
  const auto v = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  mesh.faces.insert(mesh.faces.begin(), {v, v + 1, v + 2});
  mesh.faces.push_back({v, v + 2, v + 1});
  CHECK(surveyEdges(mesh).isManifold);
  CHECK(representativesOf(mesh).back() == mesh.faces.size() - 1);
  mesh.faces.push_back({v + 2, v, v + 1});
  const std::vector<uint32_t> representatives = representativesOf(mesh);
  CHECK(representatives.back() == 0);
  CHECK(representatives[1] == 1);
}

TEST_CASE("of two closed shells with vertices of their own at the same places one is the other's copy") {
  const Mesh mesh = shapes::joined(shapes::cube(), shapes::cube());
  CHECK(surveyEdges(mesh).isManifold);
  const std::vector<uint32_t> representatives = representativesOf(mesh);
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) CHECK(representatives[f] == f % 12);
}

TEST_CASE("faces of a clean mesh represent themselves") {
  const Mesh mesh = shapes::cube();
  std::vector<uint32_t> itself(mesh.faces.size());
  std::iota(itself.begin(), itself.end(), 0u);
  CHECK(representativesOf(mesh) == itself);
  CHECK(representativesOf({}).empty());
}

TEST_CASE("faces with the same vertices in the same winding, from any of them on, share the lowest face") {
  Mesh mesh;
  mesh.vertices.resize(5);
  mesh.faces = {{4, 3, 2}, {0, 1, 2}, {1, 2, 0}, {2, 1, 0}, {0, 1, 3}, {0, 2, 1}, {2, 4, 3}};
  CHECK(representativesOf(mesh) == std::vector<uint32_t>{0, 1, 1, 3, 4, 3, 0});
}

TEST_CASE("faces that share an edge or a repeated vertex do not coincide") {
  Mesh mesh;
  mesh.vertices.resize(4);
  mesh.faces = {{0, 1, 2}, {0, 1, 3}, {0, 0, 1}, {0, 1, 1}, {1, 0, 0}};
  CHECK(representativesOf(mesh) == std::vector<uint32_t>{0, 1, 2, 3, 2});
}

TEST_CASE("representatives of random soups equal those by comparison of all faces") {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const Mesh mesh = shapes::randomFaces(5, 80, seed);
    const auto isRotation = [](Face a, const Face& b) {
      for (int i = 0; i < 3 && a != b; ++i) std::rotate(a.begin(), a.begin() + 1, a.end());
      return a == b;
    };
    std::vector<uint32_t> expected;
    for (const Face& face : mesh.faces) {
      uint32_t lowest = 0;
      while (!isRotation(mesh.faces[lowest], face)) ++lowest;
      expected.push_back(lowest);
    }
    REQUIRE(representativesOf(mesh) == expected);
  }
}

TEST_CASE("a copy with vertices of its own coincides with the original, in the same winding") {
  const Mesh sphere = shapes::sphere(3);
  const uint32_t count = sphere.faceCount();
  for (const bool isInverted : {false, true}) {
    const std::vector<uint32_t> representatives =
        representativesOf(shapes::joined(sphere, isInverted ? shapes::inverted(sphere) : sphere));
    REQUIRE(representatives.size() == 2 * size_t{count});
    for (uint32_t f = 0; f < representatives.size(); ++f) REQUIRE(representatives[f] == (isInverted ? f : f % count));
  }
  const std::vector<uint32_t> moved =
      representativesOf(shapes::joined(sphere, shapes::scaledAndShifted(sphere, 1, {1e-15, 0, 0})));
  CHECK(moved[count + 1] == count + 1);  // Near is not the same.
}

TEST_CASE("-0 and 0 are the same coordinate, but NaN and infinity equal none") {
  const auto twoFaces = [](double x, double otherX) {
    return Mesh{
        {{x, 0, 0}, {1, 0, 0}, {0, 1, 0}, {otherX, -0.0, 0}, {1, 0, -0.0}, {-0.0, 1, 0}}, {{0, 1, 2}, {4, 5, 3}}, {}};
  };
  using Representatives = std::vector<uint32_t>;
  CHECK(representativesOf(twoFaces(0.0, -0.0)) == Representatives{0, 0});
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK(representativesOf(twoFaces(bad, bad)) == Representatives{0, 1});
    Mesh shared = twoFaces(bad, 0);
    shared.faces = {{0, 1, 2}, {2, 0, 1}};
    CHECK(representativesOf(shared) == Representatives{0, 0});  // By index it is the same face nevertheless.
  }
}

TEST_CASE("faces that collapse into a line or a point go by their vertices") {
  const Mesh mesh{{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {2, 0, 1}, {0, 2, 2}}, {}};
  CHECK(representativesOf(mesh) == std::vector<uint32_t>{0, 1, 0, 3});
}

TEST_CASE("copies in a soup on few points, shared or not, equal those by comparison of all positions") {
  const Mesh welded = shapes::randomFaces(6, 300, 3);
  Mesh soup;
  for (const Face& face : welded.faces) {
    const auto v = static_cast<uint32_t>(soup.vertices.size());
    for (uint32_t vertex : face) soup.vertices.push_back(welded.vertices[vertex]);
    soup.faces.push_back({v, v + 1, v + 2});
  }
  const std::vector<uint32_t> expected = representativesOf(welded), actual = representativesOf(soup);
  for (uint32_t f = 0; f < welded.faceCount(); ++f)
    REQUIRE(actual[f] == (hasDistinctVertices(welded.faces[f]) ? expected[f] : f));
}
