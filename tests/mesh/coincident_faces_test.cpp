#include "mesh/coincident_faces.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "shapes.h"

using namespace asdfvk;

TEST_CASE("faces of a clean mesh represent themselves") {
  const Mesh mesh = shapes::cube();
  std::vector<uint32_t> itself(mesh.faces.size());
  std::iota(itself.begin(), itself.end(), 0u);
  CHECK(coincidentRepresentatives(mesh) == itself);
  CHECK(coincidentRepresentatives({}).empty());
}

TEST_CASE("faces with the same vertices in any order and winding share the lowest face") {
  Mesh mesh;
  mesh.vertices.resize(5);
  mesh.faces = {{4, 3, 2}, {0, 1, 2}, {1, 2, 0}, {2, 1, 0}, {0, 1, 3}, {0, 2, 1}, {2, 4, 3}};
  CHECK(coincidentRepresentatives(mesh) == std::vector<uint32_t>{0, 1, 1, 1, 4, 1, 0});
}

TEST_CASE("faces that share an edge or a repeated vertex do not coincide") {
  Mesh mesh;
  mesh.vertices.resize(4);
  mesh.faces = {{0, 1, 2}, {0, 1, 3}, {0, 0, 1}, {0, 1, 1}, {1, 0, 0}};
  CHECK(coincidentRepresentatives(mesh) == std::vector<uint32_t>{0, 1, 2, 3, 2});
}

TEST_CASE("representatives of random soups are what comparing all faces gives") {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const Mesh mesh = shapes::soup(5, 80, seed);
    const auto sorted = [](Face face) {
      std::sort(face.begin(), face.end());
      return face;
    };
    std::vector<uint32_t> expected;
    for (const Face& face : mesh.faces) {
      uint32_t lowest = 0;
      while (sorted(mesh.faces[lowest]) != sorted(face)) ++lowest;
      expected.push_back(lowest);
    }
    REQUIRE(coincidentRepresentatives(mesh) == expected);
  }
}
