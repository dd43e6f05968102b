// Files that deviate from the definition of STL in ways that occur in practice.
#include <doctest/doctest.h>

#include <cstring>
#include <limits>

#include "core/text.h"
#include "reading.h"

using namespace asdfvk;
using asdfvk::test::errorOf;
using asdfvk::test::holds;
using asdfvk::test::parse;

namespace {

using Notes = std::vector<std::string>;

constexpr size_t kStlCountOffset = 80, kStlHeaderSize = 84, kStlFaceSize = 50;

template <typename T>
void setAt(std::string& bytes, size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// A strip of faces of area 1/2 in the plane z = 0, with normals along z.
std::string stripStl(uint32_t faceCount) {
  std::string bytes(kStlHeaderSize + faceCount * kStlFaceSize, '\0');
  setAt(bytes, kStlCountOffset, faceCount);
  for (uint32_t i = 0; i < faceCount; ++i) {
    const auto x = static_cast<float>(i);
    const std::array<Vec3f, 4> facet{{{0, 0, 1}, {x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}};
    setAt(bytes, kStlHeaderSize + i * kStlFaceSize, facet);
  }
  return bytes;
}

/// The file with `size` bytes of data after each face, whose attribute has this size.
std::string withPayloads(const std::string& stl, uint16_t size, char data) {
  std::string bytes = stl.substr(0, kStlHeaderSize);
  for (size_t at = kStlHeaderSize; at < stl.size(); at += kStlFaceSize) {
    std::string facet = stl.substr(at, kStlFaceSize);
    setAt(facet, kStlFaceSize - sizeof size, size);
    bytes += facet + std::string(size, data);
  }
  return bytes;
}

std::string facetAt(int x, std::string_view first = "facet normal 0 0 1") {
  const std::string a = std::to_string(x), b = std::to_string(x + 1);
  return std::string(first) + "\nouter loop\nvertex " + a + " 0 0\nvertex " + b + " 0 0\nvertex " + a +
         " 1 0\nendloop\nendfacet\n";
}

void requireFaces(const std::string& text, size_t faceCount, const Notes& notes) {
  CAPTURE(text);
  const std::string error = errorOf("stl", text);
  CHECK(error == "no error");
  if (error != "no error") return;
  const Mesh mesh = parse("stl", text);
  CHECK(mesh.faces.size() == faceCount);
  CHECK(mesh.skipped == notes);
}

}  // namespace

TEST_CASE("bytes after the last face of a binary STL are ignored and reported") {
  for (const std::string& tail :
       {std::string("x"), std::string("\r\n"), std::string(4096, '\0'), std::string(50, '\0'), std::string(700, 't')}) {
    const Mesh mesh = parse("stl", stripStl(12) + tail);
    CHECK(mesh.faces.size() == 12);
    CHECK(mesh.skipped == Notes{counted(tail.size(), "byte") + " after the last face"});
  }
  CHECK(parse("stl", stripStl(12)).skipped.empty());
}

TEST_CASE("whole rows after the last face of a binary STL that are text or zeros are no faces") {
  for (const std::string& tail : {std::string("CREATED BY CAD TOOL 7.2, 2026-01-31, UNITS: MM    "),
                                  std::string(49, '\0') + "x", std::string(50, ' '), std::string(100, '0')}) {
    const Mesh mesh = parse("stl", stripStl(12) + tail);
    CHECK(mesh.faces.size() == 12);
    CHECK(mesh.skipped == Notes{counted(tail.size(), "byte") + " after the last face"});
  }
}

TEST_CASE("a binary STL with face count 0 or one that is too small has the faces that its size implies") {
  for (const uint32_t count : {0, 1, 11}) {
    std::string bytes = stripStl(12);
    setAt(bytes, kStlCountOffset, count);
    const Mesh mesh = parse("stl", bytes);
    CHECK(mesh.faces.size() == 12);
    CHECK(mesh.skipped == Notes{"1 wrong face count (" + std::to_string(count) + " instead of 12)"});
    // Whole faces and a further byte may be a truncated face.
    CHECK(errorOf("stl", bytes + "x") != "no error");
  }
}

TEST_CASE("data after each face of a binary STL, whose size is the attribute, is ignored and reported") {
  for (const char data : {'\0', '\x7f'}) {
    const Mesh mesh = parse("stl", withPayloads(stripStl(12), 6, data));
    CHECK(mesh.faces == parse("stl", stripStl(12)).faces);
    CHECK(mesh.vertices == parse("stl", stripStl(12)).vertices);
    CHECK(mesh.skipped == Notes{"72 bytes of data between the faces"});
  }
  CHECK(errorOf("stl", withPayloads(stripStl(12), 6, 'x') + "x") != "no error");
}

TEST_CASE("a binary STL whose faces are in doubt is refused with the byte") {
  const std::string good = stripStl(12);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto withFloat = [&](size_t face, size_t number, float value) {
    std::string bytes = good;
    setAt(bytes, kStlHeaderSize + face * kStlFaceSize + number * sizeof value, value);
    return bytes;
  };
  const std::string expected = "byte 684: binary STL with 12 faces must have 684 bytes; this file has ";
  for (const float value : {nan, std::numeric_limits<float>::infinity(), 1e30f, 1e-30f}) {
    CHECK(holds(errorOf("stl", withFloat(5, 4, value) + "xx"), expected + "686 and continues after the last face"));
    CHECK(parse("stl", withFloat(5, 4, value)).faces.size() == 12);  // The exact size leaves no doubt.
  }
  // One of twelve normals may be wrong, but not two.
  std::string wrongNormals = withFloat(3, 0, 9);
  CHECK(parse("stl", wrongNormals + "xx").skipped == Notes{"2 bytes after the last face"});
  setAt(wrongNormals, kStlHeaderSize + 4 * kStlFaceSize, 9.0f);
  CHECK(holds(errorOf("stl", wrongNormals + "xx"), expected + "686"));
  // A second STL after the first, and further faces with a rest, would be lost.
  CHECK(holds(errorOf("stl", good + good), expected + "1368"));
  CHECK(holds(errorOf("stl", good + good.substr(kStlHeaderSize) + "x"), expected + "1285"));
  // Also at a position that is no multiple of the size of a face.
  for (const size_t gap : {1, 3, 49, 57})
    CHECK(holds(errorOf("stl", good + std::string(gap, '\0') + good.substr(kStlHeaderSize)), expected));
  // Faces without area are no evidence.
  CHECK(errorOf("stl", std::string(80, '\0') + std::string("\1\0\0\0", 4) + std::string(52, '\0')) != "no error");
  CHECK(errorOf("stl", std::string(84 + 500, '\0')) != "no error");
  // More faces in the header than in the file: truncated, also at the end of a face.
  for (size_t size = kStlHeaderSize; size < good.size(); ++size)
    CHECK(holds(errorOf("stl", good.substr(0, size)), "is truncated"));
}

TEST_CASE("variants of the keywords that end an ASCII STL are read") {
  for (const char* end : {"endsolid x\n", "end solid x\n", "endsolidx", "ENDSOLIDX y\n", "End Solid", "endsolid"})
    requireFaces("solid x\n" + facetAt(0) + facetAt(1) + end, 2, {});
  std::string text = "solid x\n" + facetAt(0) + facetAt(1) + "endsolid x\n";
  for (const auto& [from, to] : {std::pair{"endloop", "end loop"}, {"endfacet", "end facet"}})
    for (size_t at = text.find(from); at != std::string::npos; at = text.find(from))
      text.replace(at, std::strlen(from), to);
  requireFaces(text + text, 4, {});
}

TEST_CASE("text of an ASCII STL that is no face is ignored and reported") {
  const Notes line{"1 line of text between the faces"};
  requireFaces("solid a\nsolid a\n" + facetAt(0) + "endsolid a\n", 1, line);
  requireFaces("solid a\nsolid my facet\n" + facetAt(0) + "endsolid a\nendsolid b\n", 1,
               {"2 lines of text between the faces"});
  requireFaces("solid a\ncolor 0.5 0.5 1\n" + facetAt(0) + "endsolid a\n", 1, line);
  requireFaces("solid a\n" + facetAt(0) + "  color 1 0 0\n" + facetAt(1) + "endsolid a\n", 2, line);
  std::string within = facetAt(0);
  within.insert(within.find("outer"), "color .5 1 0 ");
  requireFaces("solid a\n" + within + "endsolid\n", 1, line);
  within.insert(within.find("outer"), "\n");
  requireFaces("solid a\n" + within + "endsolid\n", 1, line);
  requireFaces("solid a name\nof two lines\n" + facetAt(0) + "endsolid a name\nof two lines\n", 1,
               {"2 lines of text between the faces"});
  requireFaces("; from CAD\nsolid a\n// all of it\n" + facetAt(0) + "# facet normal 0 0 1\n" + facetAt(1) +
                   "endsolid a\n# end\n",
               2, {"4 comments"});
  requireFaces(
      "solid a\nfacet normal 0 0 1 # up\nouter loop\nvertex 0 0 0 ; first\n;\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid\n",
      1, {"3 comments"});
}

TEST_CASE("a face of an ASCII STL is never taken for a part of a name") {
  for (const char* lineEnd : {"\n", "\r\n", "\r", " "}) {
    std::string text;
    for (const char c : "solid x\n" + facetAt(0) + facetAt(1) + "endsolid x\nsolid y\n" + facetAt(2) + "endsolid y\n")
      c == '\n' ? text += lineEnd : text += c;
    requireFaces(text, 3, {});
  }
  requireFaces("solid x " + facetAt(0) + facetAt(1) + "endsolid x\n", 2, {});
  requireFaces("solid x facet\n" + facetAt(0, "normal 0 0 1") + "endsolid x\n", 1, {});
  requireFaces("solid a\ncolor 1 0 0 " + facetAt(0) + "endsolid\n", 1, {"1 line of text between the faces"});
  requireFaces("solid a\n" + facetAt(0) + "endsolid a " + facetAt(1) + "endsolid\n", 2, {});
  for (const char* name : {"my facet", "facet", "facet endsolid solid", "outer shell", "vertex", "loop normal"})
    requireFaces("solid " + std::string(name) + "\n" + facetAt(0) + "endsolid " + name + "\n", 1, {});
}

TEST_CASE("the solids of an ASCII STL have names, those of a binary STL have none") {
  using Named = std::vector<NamedFaces>;
  const auto objectsOf = [](const std::string& text) { return parse("stl", text).objects; };
  const std::string two = facetAt(0) + facetAt(1);
  CHECK(objectsOf("solid\n" + two + "endsolid\n").empty());
  CHECK(objectsOf("solid\n" + two + "endsolid\nsolid left\tarm \r\n" + two +
                  "endsolid left arm\nsolid empty\nendsolid\n" + "SOLID right\n" + two + "endsolid\nsolid\n" + two +
                  "endsolid\n") == Named{{2, "left arm"}, {4, "right"}, {6, ""}});
  CHECK(objectsOf("solid a " + two + "endsolid a solid b " + two + "endsolid") == Named{{0, "a"}, {2, ""}});
  CHECK(objectsOf("solid a facet\nof two lines\nsolid c\n" + two + "endsolid\n") == Named{{0, "a facet"}});
  CHECK(objectsOf("solid " + stripStl(12).substr(6)).empty());
}

TEST_CASE("text of an ASCII STL that may be a damaged face is refused with the line") {
  const std::string face = facetAt(0);
  CHECK(holds(errorOf("stl", "solid a\n" + facetAt(0, "fcet normal 0 0 1") + "endsolid\n"),
              "line 2: expected 'facet' or 'endsolid', found 'normal'"));
  CHECK(holds(errorOf("stl", "solid a\n" + facetAt(0, "fcet") + "endsolid\n"), "line 3: expected 'facet'"));
  CHECK(holds(errorOf("stl", "solid a\n" + facetAt(0, "# facet normal 0 0 1") + "endsolid\n"), "line 3: expected"));
  CHECK(holds(errorOf("stl", "solid a fcet normal 0 0 1 outer loop vertex 0 0 0\nendsolid\n"), "line 1: 'outer loop'"));
  CHECK(holds(errorOf("stl", "solid a\n" + face + "rubbish\n" + face + "endsolid\n"), "line 9: expected 'facet'"));
  CHECK(holds(errorOf("stl", "solid a\n" + face + "solid b\n" + face + "endsolid\n"), "line 9: expected 'facet'"));
  CHECK(holds(errorOf("stl", "solid a\nb\n" + face + "endsolid a\n" + face), "line 11: expected 'solid'"));
  CHECK(holds(errorOf("stl", "solid a\n" + face + "end\n"), "line 9: expected 'facet' or 'endsolid', found 'end'"));
  const std::string text =
      "Dear reader,\nthis is a letter that has more than 84 characters, so that it may be binary STL.\n";
  CHECK(errorOf("stl", text) == "is a text, but does not begin with 'solid' as ASCII STL does");
}

TEST_CASE("corners of an ASCII STL are rounded to float32 before they are welded") {
  const std::string a =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0.7071067811865475 0 0\nvertex 0 0.1 0\n"
      "endloop\nendfacet\n";
  const std::string b =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0.10000000000000002 0\n"
      "vertex 0.7071067811865477 0 0\nendloop\nendfacet\n";
  const Mesh mesh = parse("stl", "solid\n" + a + b + "endsolid\n");
  CHECK(mesh.faces == std::vector<Face>{{0, 1, 2}, {0, 2, 1}});
  CHECK(mesh.vertices[1].x == static_cast<double>(0.7071067811865475f));
  CHECK(errorOf("stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 1e39 0\n") ==
        "line 4: a vertex coordinate is too large for STL, which has float32: 1e+39");
}

TEST_CASE("an undefined number or a decimal comma in ASCII STL is an error with its cause") {
  const std::string head = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 ";
  for (const char* word : {"1.#QNAN", "-1.#IND", "1.#INF"})
    CHECK(holds(errorOf("stl", head + word + "\n"),
                "line 4: expected a vertex coordinate, found '" + std::string(word) + "', which is not a number"));
  CHECK(holds(errorOf("stl", head + "0,5\n"), "decimal comma"));
}
