#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "reading.h"

using namespace asdfvk;
using asdfvk::test::errorOf;
using asdfvk::test::holds;
using asdfvk::test::parse;

namespace {

using Triangle = std::array<Vec3f, 3>;

std::string binaryStl(std::string_view header, const std::vector<Triangle>& triangles) {
  std::string bytes(header);
  bytes.resize(80, '\0');
  const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  append(static_cast<uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    append(Vec3f{0, 0, 1});
    for (const Vec3f& corner : triangle) append(corner);
    append(uint16_t{0x1234});
  }
  return bytes;
}

const std::vector<Triangle> kStlSquare = {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}, {{{0, -0.0f, 0}, {1, 1, 0}, {0, 1, 0}}}};
const std::vector<Face> kSquareFaces = {{0, 1, 2}, {0, 2, 3}};

const std::string kFacets =
    "facet normal 0 0 1\n  outer loop\n\n    vertex 0 0 0\n    vertex 1 0 0\n    vertex 1 1 0\n  endloop\nendfacet\n\n"
    "facet normal -nan 1.#IND 1\n  outer loop\n    vertex -0 0.0 0\n    vertex 1.0 1e0 0\n    vertex 0 1 -0.0\n"
    "  endloop\nendfacet\n";

void requireSquare(const Mesh& mesh) {
  CHECK(mesh.vertices == asdfvk::test::kSquare);
  CHECK(mesh.faces == kSquareFaces);
  CHECK(mesh.polygons.isEmpty());
  for (const Vec3d& p : mesh.vertices) CHECK(!(std::signbit(p.x) || std::signbit(p.y) || std::signbit(p.z)));
}

}  // namespace

TEST_CASE("binary STL is welded, also where its header begins with solid") {
  for (const char* header : {"", "binary", "solid outer shell", "solid\nfacet normal 0 0 1\nouter loop"})
    requireSquare(parse("stl", binaryStl(header, kStlSquare)));
}

TEST_CASE("ASCII STL is welded: any name, blank lines, several solids, capitals") {
  for (const char* name : {"", " outer shell", " facet endsolid solid"}) {
    CAPTURE(name);
    requireSquare(parse("stl", "solid" + std::string(name) + "\n" + kFacets + "endsolid" + name + "\n"));
  }
  std::string text = "  solid x\n" + kFacets + "endsolid x\n\nsolid y\n" + kFacets + "endsolid";
  const Mesh twice = parse("stl", text);
  CHECK(twice.vertices == asdfvk::test::kSquare);
  CHECK(twice.faces == std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}});
  for (char& c : text) c = c == '\n' ? '\r' : static_cast<char>(std::toupper(c));
  CHECK(parse("stl", text).faces == twice.faces);
}

TEST_CASE("corners with a NaN are never welded, infinite ones are") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Mesh mesh = parse(
      "stl", binaryStl("", {{{{nan, 0, 0}, {inf, 0, 0}, {nan, 0, 0}}}, {{{0, nan, 0}, {inf, 0, 0}, {0, -inf, 0}}}}));
  CHECK(mesh.faces == std::vector<Face>{{0, 1, 2}, {3, 1, 4}});
}

TEST_CASE("vertices keep the order of first appearance in an STL of 50,000 points") {
  constexpr uint32_t kPointCount = 50000;
  const auto point = [](uint32_t i) { return Vec3f{1e-3f * i, -1.0f * (i % 7), 1e20f * i}; };
  std::vector<Triangle> triangles;
  for (uint32_t i = 0; i < kPointCount; ++i)
    triangles.push_back({point(i), point((i + 1) % kPointCount), point(i / 2)});
  const Mesh mesh = parse("stl", binaryStl("", triangles));
  REQUIRE(mesh.vertices.size() == kPointCount);
  size_t wrongCount = 0;
  for (uint32_t i = 0; i < kPointCount; ++i) {
    wrongCount += mesh.vertices[i] == static_cast<Vec3d>(point(i)) ? 0 : 1;
    wrongCount += mesh.faces[i] == Face{i, (i + 1) % kPointCount, i / 2} ? 0 : 1;
  }
  CHECK(wrongCount == 0);
}

TEST_CASE("errors of an STL file name the line or the size and the reason") {
  CHECK(holds(errorOf("stl", ""), "neither ASCII STL"));
  CHECK(holds(errorOf("stl", "solid\nendsolid\n"), "neither points nor faces"));
  CHECK(holds(errorOf("stl", binaryStl("", {})), "neither points nor faces"));
  const std::string binary = binaryStl("", kStlSquare);
  for (size_t size = 0; size < binary.size(); ++size) CHECK(errorOf("stl", binary.substr(0, size)) != "no error");
  const std::string ascii = "solid\n" + kFacets + "endsolid";
  for (size_t size = 0; size < ascii.size(); ++size) CHECK(errorOf("stl", ascii.substr(0, size)) != "no error");
  CHECK(holds(errorOf("stl", "solid\nvertex 0 0 0\n"), "line 2: expected 'facet' or 'endsolid', found 'vertex'"));
  CHECK(holds(errorOf("stl", ascii + "\nrubbish\n"), "line 19: expected 'solid', found 'rubbish'"));
  CHECK(holds(errorOf("stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0,5\n"),
              "line 4: expected a vertex coordinate, found '0,5'"));
  CHECK(holds(errorOf("stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"),
              "line 6: expected 'vertex', found 'endloop'"));
}
