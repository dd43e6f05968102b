#include <doctest/doctest.h>

#include "reading.h"

using namespace asdfvk;
using asdfvk::test::errorOf;
using asdfvk::test::holds;
using asdfvk::test::kSquare;
using asdfvk::test::parse;

namespace {

const std::string kCorners = asdfvk::test::squareCorners("v ");

}  // namespace

TEST_CASE("OBJ corners are read in all their forms") {
  for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1", "f 1/ 2/ 3/",
                           "f 1// 2// 3//", "f -4 -3 -2", "f -4/-1/-1 -3/-1/-1 -2/-1/-1", "f 1 \\\n2 \\\r\n 3",
                           "f 1 2 3\\\n", "fo 1 2 3", "f 1 2 3 # f 1 2 3", "  f\t1  2 3  "}) {
    CAPTURE(face);
    const Mesh mesh = parse("obj", kCorners + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n" + face + "\n");
    CHECK(mesh.vertices == kSquare);
    CHECK(mesh.faces == std::vector<Face>{{0, 1, 2}});
    CHECK(mesh.polygons.isEmpty());
  }
}

TEST_CASE("negative OBJ indices count back from the last vertex, positive ones may refer to later vertices") {
  const Mesh mesh = parse("obj", "f 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -3 -2 -1\n");
  CHECK(mesh.vertices == kSquare);
  CHECK(mesh.faces == std::vector<Face>{{1, 2, 3}, {0, 1, 2}, {1, 2, 3}});
}

TEST_CASE("other OBJ statements are ignored, and no other file is opened") {
  const Mesh mesh =
      parse("obj",
            "# comment \\\nmtllib /dev/zero no such file.mtl\no a name\n\ng group one\ns off\nusemtl red\n"
            "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 1 0.5 0.5 0.5\nv 0 1 0\nvp 0.5\nvn 0 0 1\nvt 0 0 0\n"
            "l 1 2 3\np 1\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\nf 1 2 3 4\n");
  CHECK(mesh.vertices == kSquare);
  CHECK(mesh.faces == std::vector<Face>{{0, 1, 2}, {0, 2, 3}});
  CHECK(mesh.polygons.inputFaceOf == std::vector<uint32_t>{0, 0});
}

TEST_CASE("OBJ lines may end with CR alone and begin with a byte order mark") {
  std::string text = "\xef\xbb\xbf" + kCorners + "f 1 2 3\n";
  for (char& c : text) c = c == '\n' ? '\r' : c;
  CHECK(parse("obj", text).vertices == kSquare);
}

TEST_CASE("errors of an OBJ file name the line and the reason") {
  CHECK(holds(errorOf("obj", ""), "neither points nor faces"));
  CHECK(holds(errorOf("obj", kCorners), "4 points and no face"));
  CHECK(holds(errorOf("obj", "Dear reader,\nthis is a letter.\n"), "line 1: 'Dear' is not an OBJ keyword"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 5\nf 1 2 3\n"), "line 5: vertex index 5 is out of range"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 -5\n"), "line 5: vertex index -5 is out of range"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 0\n"), "line 5: vertex index 0"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 4294967297\n"), "line 5: vertex index 4294967297"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 99999999999999999999\n"), "'99999999999999999999' is not a corner"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 3/x\n"), "line 5: '3/x' is not a corner"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 3/1/1/1\n"), "'3/1/1/1' is not a corner"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 3.0\n"), "'3.0' is not a corner"));
  CHECK(holds(errorOf("obj", kCorners + "f\n"), "line 5: a face has no corners"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2\n"), "the only face has fewer than three corners"));
  CHECK(holds(errorOf("obj", "v 0 0\n"), "line 1: a vertex has 2 numbers"));
  CHECK(holds(errorOf("obj", "v 0 0 0,5\n"), "line 1: expected a vertex coordinate, found '0,5'"));
  CHECK(holds(errorOf("obj", "v 1 2 3 4 5 6 7 8\n"), "more than seven numbers"));
  CHECK(holds(errorOf("obj", "v 1e400 0 0\n"), "too large"));
  CHECK(holds(errorOf("obj", kCorners + "call other.obj\n"), "another file, which is not opened; copy its content"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 \\\n 2 \\\n x\n"), "line 7: 'x' is not a corner"));
}

TEST_CASE("a backslash at the end of an OBJ name or comment never joins the next line") {
  for (const char* lineEnd : {"\n", "\r\n", "\r", " \t\n"})
    for (const char* statement :
         {"usemtl wood\\", "usemtl\\", "o C:\\parts\\", "g name\\", "mtllib C:\\parts\\", "usemap a\\", "maplib a\\",
          "shadow_obj a\\", "trace_obj a\\", "csh -a\\", "# comment\\", "v 0 0 0 # comment\\"}) {
      CAPTURE(statement);
      CAPTURE(lineEnd);
      const Mesh mesh = parse("obj", std::string(statement) + lineEnd + kCorners + statement + lineEnd +
                                         "f -4 -3 -2\n" + statement + lineEnd + "f -1 -2 -3\n");
      CHECK(mesh.faces.size() == 2);
      CHECK(mesh.vertices.size() == (statement[0] == 'v' ? 7 : 4));
    }
}

TEST_CASE("a backslash continues OBJ numbers, but joins no second statement in silence") {
  for (const char* lineEnd : {"\n", "\r\n", "\r", " \t\n"})
    CHECK(parse("obj", std::string("v 0 0 \\") + lineEnd + "0\nv 1 0 0\nvn 0 0 \\" + lineEnd + "1\nv 0 1 0\nf 1 2 \\" +
                           lineEnd + "3\n")
              .faces == std::vector<Face>{{0, 1, 2}});
  for (const char* statement : {"vn 0 0 1 \\", "vt 0 0\\", "s 1\\", "l 1 2 \\", "p 1\\", "parm u 0 1\\"}) {
    CAPTURE(statement);
    CHECK(holds(errorOf("obj", kCorners + "f 1 2 3\n" + statement + "\nf 1 3 4\n"),
                "line 6: a backslash joins this line and the statement 'f' of the next"));
  }
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 3 \\\nf 1 3 4\n"), "line 6: 'f' is not a corner"));
  CHECK(holds(errorOf("obj", "v 0 0 0\\\nv 1 0 0\n"), "line 2: expected a vertex coordinate, found 'v'"));
  CHECK(holds(errorOf("obj", kCorners + "f 1 2 3\\"), "line 5: '3\\' is not a corner"));
}

TEST_CASE("an undefined number or a decimal comma in OBJ is an error with its cause") {
  for (const char* word : {"1.#QNAN", "-1.#IND", "1.#INF00", "1.#SNAN0"})
    for (const std::string& corner : {std::string(word) + " 0 0", std::string("0 0 ") + word}) {
      CAPTURE(corner);
      CHECK(holds(errorOf("obj", kCorners + "v " + corner + "\nf 1 2 3\n"),
                  "line 5: expected a vertex coordinate, found '" + std::string(word) +
                      "', which is not a number: the program that wrote the file had an undefined value"));
    }
  CHECK(holds(errorOf("obj", "v 0 0 0,5\n"), "found '0,5': numbers have a decimal comma; write them with a point"));
  CHECK(holds(errorOf("obj", "v 0 0 +1,5e-3\n"), "decimal comma"));
  CHECK(!holds(errorOf("obj", "v 0 0 1,2,3\n"), "decimal comma"));
  CHECK(parse("obj", "v 0 0 0#comment\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").vertices.size() == 3);
}

TEST_CASE("OBJ: geometry that is no face is reported") {
  const Mesh mesh = parse("obj", kCorners + "f 1 2 3\np 1\nl 1 2\nl 2 3\nsurf 0 1 0 1 1 2 3 4\nend\n");
  CHECK(mesh.faceCount() == 1);
  CHECK(mesh.skipped ==
        std::vector<std::string>{"1 point statement", "2 line statements", "1 free-form curve or surface"});
  CHECK(parse("obj", kCorners + "vn 0 0 1\ns off\nf 1 2 3\n").skipped.empty());
}

TEST_CASE("OBJ names its objects by o, or else by g") {
  using Named = std::vector<NamedFaces>;
  const std::string polygon = "f 1 2 3 4\n", triangle = "f 1 2 3\n";
  const auto objectsOf = [&](const std::string& text) { return parse("obj", kCorners + text).objects; };
  CHECK(objectsOf(triangle).empty());
  // Faces are counted as in the file, not as triangles.
  CHECK(objectsOf(polygon + "o  left arm \r\n" + polygon + triangle + "o empty\no\tright #2\n" + polygon) ==
        Named{{1, "left arm"}, {3, "right #2"}});
  CHECK(objectsOf("o a\n" + triangle + "o\n" + triangle + "o b\n" + triangle + "o last\n") ==
        Named{{0, "a"}, {1, ""}, {2, "b"}});
  CHECK(objectsOf("g a b\n" + triangle + "g default\n" + triangle + "g c\n" + triangle + "s 1\ng c\n" + triangle) ==
        Named{{0, "a b"}, {1, ""}, {2, "c"}});
  CHECK(objectsOf("g a\n" + triangle + "o b\ng c\n" + triangle + "g d\n" + triangle) == Named{{1, "b"}});
  CHECK(objectsOf("o\ng a\n" + triangle + "o\n" + triangle) == Named{{0, "a"}});
  CHECK(objectsOf("o C:\\parts\\\n" + triangle) == Named{{0, "C:\\parts\\"}});
  const std::string wide = asdfvk::test::utf16(kCorners + "o a b\n" + triangle, true);
  CHECK(parseMesh(wide).objects == Named{{0, "a b"}});
}
