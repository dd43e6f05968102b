#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/text.h"
#include "reading.h"

using namespace asdfvk;
using asdfvk::test::errorOf;
using asdfvk::test::holds;
using asdfvk::test::parse;

namespace {

std::string asciiPly(std::string_view rows, std::string_view faceHeader =
                                                "element face 1\nproperty list uchar int "
                                                "vertex_indices\n") {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
         std::string(faceHeader) + "end_header\n" + std::string(rows);
}

constexpr std::string_view kPlyCorners = "0 0 0\n1 0 0\n0 1 0\n";

/// The bytes of a number in the given byte order.
template <typename T>
std::string packed(T value, bool isBig) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return isBig ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// A triangle and a quad over (0 0 0), (100 0 0), (100 50 0), (0 50 7) in numbers of type Coordinate and Index.
template <typename Coordinate, typename Index>
std::string binaryPly(std::string_view coordinateType, std::string_view indexType, bool isBig) {
  std::string text =
      std::string("ply\nformat binary_") + (isBig ? "big" : "little") + "_endian 1.0\nelement vertex 4\n";
  for (const char* axis : {"x", "y", "z"}) text += "property " + std::string(coordinateType) + " " + axis + "\n";
  text += "element face 2\nproperty list " + std::string(indexType) + " " + std::string(indexType) +
          " vertex_index\nend_header\n";
  for (const int number : {0, 0, 0, 100, 0, 0, 100, 50, 0, 0, 50, 7})
    text += packed(static_cast<Coordinate>(number), isBig);
  for (const int number : {3, 0, 1, 2, 4, 0, 1, 2, 3}) text += packed(static_cast<Index>(number), isBig);
  return text;
}

template <typename Coordinate, typename Index>
void requireTriangleAndQuad(std::string_view coordinateType, std::string_view indexType) {
  for (const bool isBig : {false, true}) {
    CAPTURE(coordinateType);
    CAPTURE(isBig);
    const Mesh mesh = parse("ply", binaryPly<Coordinate, Index>(coordinateType, indexType, isBig));
    CHECK(mesh.vertices == std::vector<Vec3d>{{0, 0, 0}, {100, 0, 0}, {100, 50, 0}, {0, 50, 7}});
    REQUIRE(mesh.faces.size() == 3);
    CHECK(mesh.faces[0] == Face{0, 1, 2});
    CHECK(mesh.polygons.firstCorner == std::vector<uint64_t>{0, 3, 7});
    CHECK(mesh.polygons.corners == std::vector<uint32_t>{0, 1, 2, 0, 1, 2, 3});
    CHECK(mesh.polygons.inputFaceOf == std::vector<uint32_t>{0, 1, 1});
  }
}

/// Two triangles around a quad, with further properties. lengthType: the type Length of the list lengths.
template <typename Length>
std::string plyWithFurtherProperties(std::string_view lengthType, bool isBig) {
  std::string text = std::string("ply\nformat binary_") + (isBig ? "big" : "little") + "_endian 1.0\n" +
                     "element vertex 4\nproperty uchar tag\nproperty float z\nproperty double y\nproperty float x\n" +
                     "element face 3\nproperty float quality\nproperty list " + std::string(lengthType) +
                     " int vertex_indices\nproperty uchar seed\nend_header\n";
  for (int i = 0; i < 4; ++i)
    text += packed(uint8_t{7}, isBig) + packed(0.5F + static_cast<float>(i), isBig) +
            packed(static_cast<double>(i * i), isBig) + packed(static_cast<float>(i), isBig);
  for (const std::vector<int>& corners : {std::vector{0, 1, 2}, std::vector{0, 1, 2, 3}, std::vector{3, 2, 1}}) {
    text += packed(0.25F, isBig) + packed(static_cast<Length>(corners.size()), isBig);
    for (const int corner : corners) text += packed(corner, isBig);
    text += packed(uint8_t{1}, isBig);
  }
  return text;
}

}  // namespace

TEST_CASE("binary PLY rows of triangles, and other rows, may have further properties") {
  for (const bool isBig : {false, true})
    for (const std::string& text :
         {plyWithFurtherProperties<uint8_t>("uchar", isBig), plyWithFurtherProperties<int32_t>("int", isBig)}) {
      CAPTURE(isBig);
      const Mesh mesh = parse("ply", text);
      CHECK(mesh.vertices == std::vector<Vec3d>{{0, 0, 0.5}, {1, 1, 1.5}, {2, 4, 2.5}, {3, 9, 3.5}});
      CHECK(mesh.polygons.corners == std::vector<uint32_t>{0, 1, 2, 0, 1, 2, 3, 3, 2, 1});
      CHECK(mesh.polygons.inputFaceOf == std::vector<uint32_t>{0, 1, 1, 2});
    }
}

TEST_CASE("PLY numbers of every type are read in both byte orders") {
  requireTriangleAndQuad<int8_t, uint8_t>("char", "uchar");
  requireTriangleAndQuad<int8_t, uint8_t>("int8", "uint8");
  requireTriangleAndQuad<uint8_t, int8_t>("uchar", "char");
  requireTriangleAndQuad<uint8_t, int8_t>("uint8", "int8");
  requireTriangleAndQuad<int16_t, uint16_t>("short", "ushort");
  requireTriangleAndQuad<int16_t, uint16_t>("int16", "uint16");
  requireTriangleAndQuad<uint16_t, int16_t>("ushort", "short");
  requireTriangleAndQuad<uint16_t, int16_t>("uint16", "int16");
  requireTriangleAndQuad<int32_t, uint32_t>("int", "uint");
  requireTriangleAndQuad<int32_t, uint32_t>("int32", "uint32");
  requireTriangleAndQuad<uint32_t, int32_t>("uint", "int");
  requireTriangleAndQuad<uint32_t, int32_t>("uint32", "int32");
  requireTriangleAndQuad<float, int32_t>("float", "int");
  requireTriangleAndQuad<float, int32_t>("float32", "int");
  requireTriangleAndQuad<double, int32_t>("double", "int");
  requireTriangleAndQuad<double, int32_t>("float64", "int");
}

TEST_CASE("PLY properties, lists and elements outside of the mesh are ignored in every encoding") {
  const std::string header =
      "element camera 2\nproperty list uchar short path\nproperty float lens\nelement nothing 5\n"
      "element vertex 3\nproperty uchar red\nproperty double x\nproperty list uchar int ring\nproperty float y\n"
      "property short z\nproperty float w\nelement face 2\nproperty list ushort float texcoord\n"
      "property float quality\nproperty list uchar uint vertex_indices\nproperty list uchar uchar name\n"
      "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  const std::string ascii = "ply\nformat ascii 1.0\ncomment element face 7\n" + header +
                            "2 7 8 0.5\n0 0.25\n"
                            "9 0 1 5 0 0 1\n9 1 0 0 0 1\n9 0 2 5 6 1 0 1\n"
                            "2 0.5 0.25 0.5 3 0 1 2 1 65\n0 0.5 3 2 1 0 0\n"
                            "0 1\n";
  const std::vector<Vec3d> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Face> faces = {{0, 1, 2}, {2, 1, 0}};
  const Mesh fromAscii = parse("ply", ascii);
  CHECK(fromAscii.vertices == vertices);
  CHECK(fromAscii.faces == faces);
  CHECK(fromAscii.polygons.isEmpty());

  for (const bool isBig : {false, true}) {
    CAPTURE(isBig);
    std::string bytes = std::string("ply\nformat binary_") + (isBig ? "big" : "little") + "_endian 1.0\n" + header;
    const auto u8 = [&](int v) { bytes += packed(static_cast<uint8_t>(v), isBig); };
    const auto i16 = [&](int v) { bytes += packed(static_cast<int16_t>(v), isBig); };
    const auto i32 = [&](int v) { bytes += packed(v, isBig); };
    const auto f32 = [&](float v) { bytes += packed(v, isBig); };
    u8(2), i16(7), i16(8), f32(0.5f), u8(0), f32(0.25f);
    const int ringSizes[] = {1, 0, 2};
    for (int v = 0; v < 3; ++v) {
      u8(9), bytes += packed(vertices[static_cast<size_t>(v)].x, isBig), u8(ringSizes[v]);
      for (int i = 0; i < ringSizes[v]; ++i) i32(5 + i);
      f32(static_cast<float>(vertices[static_cast<size_t>(v)].y)), i16(0), f32(1);
    }
    i16(2), f32(0.5f), f32(0.25f), f32(0.5f), u8(3), i32(0), i32(1), i32(2), u8(1), u8(65);
    i16(0), f32(0.5f), u8(3), i32(2), i32(1), i32(0), u8(0);
    i32(0), i32(1);
    const Mesh mesh = parse("ply", bytes);
    CHECK(mesh.vertices == vertices);
    CHECK(mesh.faces == faces);
    CHECK(errorOf("ply", bytes.substr(0, bytes.size() - 1)) != "no error");
    CHECK(holds(errorOf("ply", bytes + "four"), "unexpected 4 bytes after the last row"));
  }
}

TEST_CASE("every truncation of a PLY file is an error") {
  for (const std::string& whole :
       {binaryPly<float, int32_t>("float", "int", false), binaryPly<double, uint8_t>("double", "uchar", true),
        plyWithFurtherProperties<uint8_t>("uchar", true), asciiPly("0 0 0\n1 0 0\n0 1 0\n3 0 1 2")})
    for (size_t size = 0; size < whole.size(); ++size) {
      CAPTURE(size);
      CHECK(errorOf("ply", std::string_view(whole).substr(0, size)) != "no error");
    }
}

TEST_CASE("PLY tristrips become triangles of one winding, restarted at -1, without the connecting triangles") {
  const std::string header =
      "element vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n";
  const Mesh mesh = parse("ply", "ply\nformat ascii 1.0\n" + header +
                                     "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n"
                                     "12 0 1 2 3 4 -1 1 3 2 2 -1 0\n");
  CHECK(mesh.faces == std::vector<Face>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {1, 3, 2}});
  CHECK(mesh.polygons.isEmpty());
  std::string bytes = "ply\nformat binary_big_endian 1.0\n" + header;
  for (const float number : {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}) bytes += packed(number, true);
  for (const int number : {12, 0, 1, 2, 3, 4, -1, 1, 3, 2, 2, -1, 0}) bytes += packed(number, true);
  CHECK(parse("ply", bytes).faces == mesh.faces);
  CHECK(holds(errorOf("ply", "ply\nformat ascii 1.0\n" + header + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n3 0 1 -2\n"),
              "line 15: vertex index -2 is out of range"));
}

TEST_CASE("PLY header lines may end with LF, CRLF or CR, whatever the first byte of the body is") {
  const std::string lf =
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar uchar vertex_indices\n"
      "element vertex 11\nproperty uchar x\nproperty uchar y\nproperty uchar z\nend_header\n";
  // Ten corners: the body begins with an LF byte.
  const std::string body = "\n" + std::string("\0\1\2\3\4\5\6\7\10\11", 10) + std::string(33, '\1');
  for (const char* lineEnd : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : lf) c == '\n' ? text += lineEnd : text += c;
    const Mesh mesh = parse("ply", text + body);
    CHECK(mesh.polygons.corners.size() == 10);
    CHECK(mesh.vertices.size() == 11);
    CHECK(mesh.vertices[10] == Vec3d{1, 1, 1});
  }
}

TEST_CASE("ASCII PLY accepts signs, exponents, inf and nan; numbers below the range of double are 0") {
  const Mesh mesh =
      parse("ply", asciiPly("nan -inf +1.5\n1e39 4.9e-324 1e-400\n-1E-999999999999999999999 .5 5.\n3 0 1 2\n"));
  CHECK(std::isnan(mesh.vertices[0].x));
  CHECK(mesh.vertices[0].y == -std::numeric_limits<double>::infinity());
  CHECK(mesh.vertices[0].z == 1.5);
  CHECK(mesh.vertices[1] == Vec3d{1e39, 4.9e-324, 0});
  CHECK(mesh.vertices[2] == Vec3d{0, 0.5, 5});
  CHECK(holds(errorOf("ply", asciiPly("0 0 1e400\n")), "truncated"));
  CHECK(holds(errorOf("ply", asciiPly("0 0 1e400\n1 0 0\n0 1 0\n3 0 1 2\n")), "line 10: z is too large"));
  for (const char* tiny :
       {"1e-400", "0.00001e-9223372036854775807", "1e-9223372036854775808", "-1e-99999999999999999999"})
    CHECK(parse("ply", asciiPly(std::string(tiny) + " 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).vertices[0] == Vec3d{0, 0, 0});
  for (const char* huge : {"1e400", "123e9223372036854775807", "1e+9223372036854775808", "-1e99999999999999999999"})
    CHECK(holds(errorOf("ply", asciiPly(std::string(huge) + " 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")), "x is too large"));
  CHECK(parse("ply", asciiPly("0." + std::string(400, '0') + "1 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).vertices[0].x == 0);
  CHECK(
      holds(errorOf("ply", asciiPly("1" + std::string(400, '0') + " 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")), "x is too large"));
  CHECK(holds(errorOf("ply", asciiPly("0 0 0,5\n1 0 0\n0 1 0\n3 0 1 2\n")), "line 10: expected z, found '0,5'"));
}

TEST_CASE("ASCII PLY of CRLF lines, with blank lines and a byte order mark, is read") {
  std::string text = "\xef\xbb\xbf";
  for (const char c : asciiPly("\n0 0 0\n1 0 0\n\n0 1 0\n3 0 1\n2\n\n")) c == '\n' ? text += "\r\n" : text += c;
  CHECK(parse("ply", text).faces == std::vector<Face>{{0, 1, 2}});
}

TEST_CASE("errors of a PLY file name the line or byte and the reason") {
  const std::string corners(kPlyCorners);
  CHECK(holds(errorOf("ply", ""), "line 1"));
  CHECK(holds(errorOf("ply", "plx\n"), "begins with 'ply'"));
  CHECK(holds(errorOf("ply", "ply\nformat ascii 2.0\n"), "line 2: PLY version '2.0' is not supported"));
  CHECK(holds(errorOf("ply", "ply\nformat text 1.0\n"), "'text' is not a PLY encoding"));
  CHECK(holds(errorOf("ply", "ply\nelement vertex 3\nend_header\n"), "without a format line"));
  CHECK(holds(errorOf("ply", "ply\nformat ascii 1.0\nelement vertex -3\n"),
              "line 3: the count of the element is negative"));
  CHECK(
      holds(errorOf("ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\n"), "'half' is not a PLY type"));
  CHECK(holds(errorOf("ply", asciiPly(corners + "3 0 1 3\n")), "line 13: vertex index 3 is out of range"));
  CHECK(holds(errorOf("ply", asciiPly(corners + "3 0 1 -1\n")), "line 13: vertex index -1 is out of range"));
  CHECK(holds(errorOf("ply", asciiPly(corners + "3 0 1 2 7\n")), "line 13: row 0 of element 'face' has more numbers"));
  CHECK(holds(errorOf("ply", asciiPly(corners + "3 0 1 2\n3 0 1 2\n")), "line 14: unexpected '3' after the last row"));
  CHECK(holds(errorOf("ply", asciiPly(corners + "3 0 1 2.5\n")),
              "line 13: expected a vertex index, an integer, found '2.5'"));
  CHECK(holds(errorOf("ply", asciiPly(corners + "-1 0 1 2\n")), "a list of length -1 does not fit"));
  CHECK(holds(errorOf("ply", asciiPly(corners, "")), "a point cloud"));
  CHECK(holds(errorOf("ply", asciiPly(corners, "element face 0\nproperty list uchar int vertex_indices\n")),
              "3 points and no face"));
  CHECK(holds(errorOf("ply", asciiPly(corners + "2 0 1\n")), "the only face has fewer than three corners"));
  CHECK(holds(errorOf("ply", asciiPly(corners + "1\n", "element face 1\nproperty int vertex_indices\n")),
              "must be a list of integers"));
  CHECK(holds(errorOf("ply", asciiPly(corners + "1\n", "element face 1\nproperty int x\n")), "no list vertex_indices"));
  const std::string binary = binaryPly<float, uint8_t>("float", "uchar", false);
  std::string wrong = binary;
  wrong.back() = 4;
  CHECK(errorOf("ply", wrong) ==
        "byte " + std::to_string(wrong.size() - 1) + ": vertex index 4 is out of range; the mesh has 4 vertices");
}

TEST_CASE("an index out of range in a binary PLY of triangles is an error") {
  for (const int index : {3, -1, 70000}) {
    CAPTURE(index);
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n" +
        std::string(9, '\0');
    for (const auto& face : {std::array{0, 1, 2}, std::array{2, index, 0}}) {
      bytes += '\3';
      for (const int corner : face) bytes += packed(corner, false);
    }
    CHECK(errorOf("ply", bytes) == "byte " + std::to_string(bytes.size() - 2 * sizeof(int)) + ": vertex index " +
                                       std::to_string(index) + " is out of range; the mesh has 3 vertices");
  }
}

TEST_CASE("a large binary PLY gives its mesh, with and without a quad") {
  constexpr uint32_t kFaceCount = 100000;
  for (const bool hasQuad : {false, true}) {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 70000\nproperty float x\nproperty float y\n"
        "property float z\nelement face 100000\nproperty list uchar int vertex_indices\nend_header\n";
    for (uint32_t i = 0; i < 70000; ++i)
      for (uint32_t axis = 0; axis < 3; ++axis) bytes += packed(static_cast<float>(i * (axis + 1)), false);
    const auto corner = [](uint32_t face, uint32_t c) { return (face * 7919 + c * 104729) % 70000; };
    for (uint32_t face = 0; face < kFaceCount; ++face) {
      const uint32_t count = hasQuad && face == kFaceCount - 1 ? 4 : 3;
      bytes += static_cast<char>(count);
      for (uint32_t c = 0; c < count; ++c) bytes += packed(corner(face, c), false);
    }
    const Mesh mesh = parse("ply", bytes);
    REQUIRE(mesh.vertices.size() == 70000);
    REQUIRE(mesh.inputFaceCount() == kFaceCount);
    CHECK(mesh.polygons.isEmpty() == !hasQuad);
    size_t wrongCount = 0;
    for (uint32_t i = 0; i < 70000; ++i) wrongCount += mesh.vertices[i] == Vec3d{1.0 * i, 2.0 * i, 3.0 * i} ? 0 : 1;
    for (uint32_t i = 0; i < kFaceCount - 1; ++i)
      wrongCount += mesh.faces[i] == Face{corner(i, 0), corner(i, 1), corner(i, 2)} ? 0 : 1;
    CHECK(wrongCount == 0);
  }
}

TEST_CASE("PLY integers of 64 bits are read under all their names") {
  for (const char* type : {"int64", "long", "int64_t"}) requireTriangleAndQuad<int32_t, int64_t>("int32_t", type);
  for (const char* type : {"uint64", "ulong", "uint64_t"}) requireTriangleAndQuad<uint8_t, uint64_t>("uint8_t", type);
  requireTriangleAndQuad<int64_t, uint16_t>("int64", "uint16_t");
  requireTriangleAndQuad<uint64_t, int16_t>("uint64", "int16_t");
  std::string bytes = binaryPly<float, uint64_t>("float", "uint64", true);
  bytes[bytes.size() - 8] = '\xff';
  CHECK(holds(errorOf("ply", bytes), "is out of range; the mesh has 4 vertices"));
  CHECK(holds(errorOf("ply", asciiPly("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                                      "element face 1\nproperty list uchar float vertex_indices\n")),
              "must be a list of integers"));
}

TEST_CASE("padding after the last row of a PLY is ignored and reported") {
  const std::string binary = binaryPly<float, int32_t>("float", "int", false);
  const std::string ascii = asciiPly("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  for (const std::string& tail : {std::string("x"), std::string("\r\n"), std::string("\x1a"), std::string(512, '\0')})
    CHECK(parse("ply", binary + tail).skipped ==
          std::vector<std::string>{counted(tail.size(), "byte") + " after the last row"});
  CHECK(parse("ply", ascii + std::string(9, '\0')).skipped == std::vector<std::string>{"9 bytes after the last row"});
  CHECK(parse("ply", ascii + "\n\n \r\n").skipped.empty());
  CHECK(parse("ply", binary).skipped.empty());
  CHECK(holds(errorOf("ply", binary + std::string("\3\0\0\0\1\0", 6)), "unexpected 6 bytes after the last row"));
  CHECK(holds(errorOf("ply", ascii + "x"), "line 14: unexpected 'x' after the last row"));
}

TEST_CASE("unknown lines of a PLY header are ignored and reported, but not misspelt elements and properties") {
  std::string text = asciiPly("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  text.replace(text.find("1.0\n"), 4, "1.1\nCreated by Blender3D 2.49\n\nSomeTool\n");
  CHECK(parse("ply", text).skipped ==
        std::vector<std::string>{"version number 1.1 (the only version of PLY is 1.0)", "2 unknown header lines"});
  const std::string corners(kPlyCorners);
  for (const char* header : {"elment face 1\nproperty list uchar int vertex_indices\n",
                             "elment face 1\ncomment c\nproperty list uchar int vertex_indices\n",
                             "elment face 1\nSomeTool\nproperty list uchar int vertex_indices\n"})
    CHECK(
        holds(errorOf("ply", asciiPly(corners + "3 0 1 2\n", header)), "line 7: 'elment' is not a PLY header keyword"));
  for (const char* line : {"propery float q\n", "propery list uchar int vertex_indices\n", "propery int64_t q\n"})
    CHECK(holds(errorOf("ply", asciiPly(corners + "3 0 1 2\n", "element face 1\n" + std::string(line))),
                "line 8: 'propery' is not a PLY header keyword"));
}

TEST_CASE("an undefined number in ASCII PLY is an error with its cause") {
  CHECK(holds(errorOf("ply", asciiPly("0 0 1.#QNAN\n1 0 0\n0 1 0\n3 0 1 2\n")),
              "line 10: expected z, found '1.#QNAN', which is not a number: the program"));
}
