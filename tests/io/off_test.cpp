#include <doctest/doctest.h>

#include <string_view>
#include <vector>

#include "reading.h"

using namespace asdfvk;
using asdfvk::test::errorOf;
using asdfvk::test::holds;
using asdfvk::test::kSquare;
using asdfvk::test::parse;
using asdfvk::test::squareCorners;

namespace {

const std::string kOffCorners = squareCorners();

void requireSquare(std::string_view text) {
  CAPTURE(text);
  const Mesh mesh = parse("off", text);
  CHECK(mesh.vertices == kSquare);
  CHECK(mesh.faces == std::vector<Face>{{0, 1, 2}, {0, 2, 3}});
  CHECK(mesh.polygons.isEmpty());
}

}  // namespace

TEST_CASE("OFF headers in all their forms are read") {
  const std::string& corners = kOffCorners;
  const std::string faces = "3 0 1 2\n3 0 2 3\n";
  requireSquare("OFF\n4 2 0\n" + corners + faces);
  requireSquare("OFF 4 2 0\n" + corners + faces);
  requireSquare("OFF4 2 0\n" + corners + faces);
  requireSquare("OFF\n4 2\n" + corners + faces);
  requireSquare("4 2 5\n" + corners + faces);
  requireSquare("\n# made by hand\nOFF # header\n\n# counts\n4 2 0 # counts\n" + squareCorners("", " # corner") +
                "#\n" + faces + "# end");
  requireSquare("COFF\n4 2 0\n" + squareCorners("", " 255 0 0 255") + faces);
  requireSquare("COFF\n4 2 0\n" + squareCorners("", " 0.5 0 0.25") + faces);
  requireSquare("NOFF\n4 2 0\n" + squareCorners("", " 0 0 1") + faces);
  requireSquare("STOFF\n4 2 0\n" + squareCorners("", " 0.5 0.5") + faces);
  requireSquare("CNOFF\n4 2 0\n" + squareCorners("", " 0 0 1 1 1 1 1") + faces);
  requireSquare("STCNOFF\n4 2 0\n" + squareCorners("", " 0 0 1 1 1 1 1 0 0") + faces);
  requireSquare("STNCOFF\n4 2 0\n" + squareCorners("", " 0 0 1 1 1 1 0 0") + faces);
  requireSquare("OFF\r\n4 2 0\r\n" + squareCorners("", "\r") + "3 0 1 2\r\n3 0 2 3\r\n");
  std::string cr = "\xef\xbb\xbfOFF\n4 2 0\n" + corners + faces;
  for (char& c : cr) c = c == '\n' ? '\r' : c;
  requireSquare(cr);
}

TEST_CASE("OFF face colours are ignored, whether or not the keyword has C") {
  const std::string head = "OFF\n4 2 0\n" + kOffCorners;
  for (const char* colour : {"", " 7", " 255 0 0", " 0.5 0.25 1", " 255 0 0 128", " 0.1 0.2 0.3 0.4"}) {
    requireSquare(head + "3 0 1 2" + colour + "\n3 0 2 3\n");
    requireSquare(head + "3 0 1 2\n3 0 2 3" + colour);
  }
  CHECK(holds(errorOf("off", head + "3 0 1 2 1 2 3 4 5\n3 0 2 3\n"), "line 7: more than four numbers"));
  CHECK(holds(errorOf("off", head + "3 0 1 2 red\n3 0 2 3\n"), "line 7: expected a colour number, found 'red'"));
}

TEST_CASE("OFF polygons keep the map back to the faces of the file") {
  const Mesh mesh = parse("off", "OFF\n4 4 0\n" + kOffCorners + "3 0 1 2\n4 0 1 2 3\n2 0 1\n0\n");
  CHECK(mesh.inputFaceCount() == 4);
  CHECK(mesh.faces == std::vector<Face>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}});
  CHECK(mesh.polygons.firstCorner == std::vector<uint64_t>{0, 3, 7, 9, 9});
  CHECK(mesh.polygons.inputFaceOf == std::vector<uint32_t>{0, 1, 1});
}

TEST_CASE("errors of an OFF file name the line and the reason") {
  const std::string& corners = kOffCorners;
  CHECK(holds(errorOf("off", ""), "line 1"));
  CHECK(holds(errorOf("off", "# nothing\n"), "line 2"));
  CHECK(holds(errorOf("off", "hello\n"), "expected OFF or the vertex count, found 'hello'"));
  CHECK(holds(errorOf("off", "XOFF\n"), "found 'XOFF'"));
  CHECK(holds(errorOf("off", "4OFF\n"), "does not have three coordinates"));
  CHECK(holds(errorOf("off", "nOFF\n"), "does not have three coordinates"));
  CHECK(holds(errorOf("off", "OFF BINARY\n\0"), "convert the mesh to PLY"));
  CHECK(holds(errorOf("off", "OFF\n4 -2 0\n"), "the face count is negative"));
  CHECK(holds(errorOf("off", "OFF\n4 2 0 9\n" + corners), "line 2: unexpected '9' after the counts"));
  CHECK(holds(errorOf("off", "OFF\n99999999999999999999 2 0\n"), "expected the vertex count, an integer"));
  CHECK(holds(errorOf("off", "OFF\n9223372036854775807 9223372036854775807 0\n"), "do not fit"));
  CHECK(holds(errorOf("off", "OFF\n4 0 0\n" + corners), "4 points and no face"));
  CHECK(holds(errorOf("off", "OFF\n0 0 0\n"), "neither points nor faces"));
  CHECK(holds(errorOf("off", "OFF\n4 1 0\n" + corners + "3 0 1 4\n"),
              "line 7: vertex index 4 of face 0 is out of range"));
  CHECK(holds(errorOf("off", "OFF\n4 1 0\n" + corners + "3 0 1 2\n3 0 2 3\n"),
              "line 8: unexpected '3' after the last face"));
  CHECK(holds(errorOf("off", "OFF\n4 1 0\n" + squareCorners("", " 255 0 0") + "3 0 1 2\n"), "COFF has colours"));
  CHECK(holds(errorOf("off", "COFF\n4 1 0\n" + corners + "3 0 1 2\n"), "line 3: vertex 0 has 0 numbers after"));
  CHECK(holds(errorOf("off", "OFF\n4 1 0\n0 0 x\n" + corners), "line 3: expected a vertex coordinate, found 'x'"));
  const std::string whole = "OFF\n4 2 0\n" + corners + "3 0 1 2\n3 0 2 3";
  for (size_t size = 0; size < whole.size(); ++size) CHECK(errorOf("off", whole.substr(0, size)) != "no error");
}

TEST_CASE("OFF: nothing is read beyond a file that ends in a sign") {
  for (const std::string_view text : {"OFF\n1 1 0\n0 0 +", "OFF\n1 1 0\n0 0 -", "OFF\n1 1 0\n0 0 1e+", "OFF\n1 1 +"}) {
    const std::vector<char> exact(text.begin(), text.end());  // A sanitizer sees a read beyond its end.
    CHECK_FALSE(errorOf("off", {exact.data(), exact.size()}).empty());
  }
}
