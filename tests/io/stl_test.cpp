#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "io/corner_welder.h"
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
const std::vector<Vec3d> kSquareVertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Face> kSquareFaces = {{0, 1, 2}, {0, 2, 3}};

const std::string kFacets =
    "facet normal 0 0 1\n  outer loop\n\n    vertex 0 0 0\n    vertex 1 0 0\n    vertex 1 1 0\n  endloop\nendfacet\n\n"
    "facet normal -nan 1.#IND 1\n  outer loop\n    vertex -0 0.0 0\n    vertex 1.0 1e0 0\n    vertex 0 1 -0.0\n"
    "  endloop\nendfacet\n";

void requireSquare(const Mesh& mesh) {
  CHECK(mesh.vertices == kSquareVertices);
  CHECK(mesh.faces == kSquareFaces);
  CHECK(mesh.polygons.isEmpty());
  for (const Vec3d& p : mesh.vertices) CHECK(!(std::signbit(p.x) || std::signbit(p.y) || std::signbit(p.z)));
}

}  // namespace

TEST_CASE("binary STL is welded, also where its header begins with solid") {
  for (const char* header : {"", "binary", "solid outer shell", "solid\nfacet normal 0 0 1\nouter loop"})
    requireSquare(parse(parseStl, binaryStl(header, kStlSquare)));
}

TEST_CASE("ASCII STL is welded, with any name, blank lines, several solids and in capitals") {
  for (const char* name : {"", " outer shell", " facet endsolid solid"}) {
    CAPTURE(name);
    requireSquare(parse(parseStl, "solid" + std::string(name) + "\n" + kFacets + "endsolid" + name + "\n"));
  }
  std::string text = "  solid x\n" + kFacets + "endsolid x\n\nsolid y\n" + kFacets + "endsolid";
  const Mesh twice = parse(parseStl, text);
  CHECK(twice.vertices == kSquareVertices);
  CHECK(twice.faces == std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}});
  for (char& c : text) c = c == '\n' ? '\r' : static_cast<char>(std::toupper(c));
  CHECK(parse(parseStl, text).faces == twice.faces);
}

TEST_CASE("corners with a NaN are never welded, infinite ones are") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Mesh mesh = parse(
      parseStl, binaryStl("", {{{{nan, 0, 0}, {inf, 0, 0}, {nan, 0, 0}}}, {{{0, nan, 0}, {inf, 0, 0}, {0, -inf, 0}}}}));
  CHECK(mesh.faces == std::vector<Face>{{0, 1, 2}, {3, 1, 4}});
}

TEST_CASE("the welder keeps the order of first appearance while its table grows") {
  CornerWelder welder(0);
  size_t wrongCount = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (uint32_t i = 0; i < 50000; ++i)
      wrongCount += welder.indexOf({1e-3 * i, -1.0 * (i % 7), 1e20 * i}) == i ? 0 : 1;
  CHECK(wrongCount == 0);
  CHECK(welder.points().size() == 50000);
}

TEST_CASE("what is wrong with an STL file is told with its line or its size") {
  CHECK(holds(errorOf(parseStl, ""), "neither ASCII STL"));
  CHECK(holds(errorOf(parseStl, "solid\nendsolid\n"), "neither points nor faces"));
  CHECK(holds(errorOf(parseStl, binaryStl("", {})), "neither points nor faces"));
  const std::string binary = binaryStl("", kStlSquare);
  CHECK(holds(errorOf(parseStl, binary + "x"), "must have 184 bytes; this has 185 and is followed by something else"));
  CHECK(holds(errorOf(parseStl, binaryStl("solid", kStlSquare) + "x"), "followed by something else"));
  for (size_t size = 0; size < binary.size(); ++size) CHECK(errorOf(parseStl, binary.substr(0, size)) != "no error");
  const std::string ascii = "solid\n" + kFacets + "endsolid";
  for (size_t size = 0; size < ascii.size(); ++size) CHECK(errorOf(parseStl, ascii.substr(0, size)) != "no error");
  CHECK(holds(errorOf(parseStl, "solid\nvertex 0 0 0\n"),
              "line 2: 'facet' or 'endsolid' should stand here, not 'vertex'"));
  CHECK(holds(errorOf(parseStl, ascii + "\nrubbish\n"), "line 19: 'solid' should stand here, not 'rubbish'"));
  CHECK(holds(errorOf(parseStl, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0,5\n"),
              "line 4: a vertex coordinate should stand here, not '0,5'"));
  CHECK(holds(errorOf(parseStl, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"),
              "line 6: 'vertex' should stand here, not 'endloop'"));
}
