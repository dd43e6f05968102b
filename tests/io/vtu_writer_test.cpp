#include <doctest/doctest.h>

#include <cmath>

#include "written_file.h"

using namespace asdfvk;

namespace {

std::string decodeBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  REQUIRE(text.size() % 4 == 0);
  std::string bytes;
  for (size_t i = 0; i < text.size(); i += 4) {
    uint32_t bits = 0;
    int padding = 0;
    for (size_t k = 0; k < 4; ++k) {
      if (text[i + k] == '=') ++padding;
      const size_t digit = text[i + k] == '=' ? 0 : digits.find(text[i + k]);
      REQUIRE(digit < 64);
      bits = bits << 6 | static_cast<uint32_t>(digit);
    }
    for (int k = 0; k < 3 - padding; ++k) bytes += static_cast<char>(bits >> (16 - 8 * k) & 0xff);
  }
  return bytes;
}

/// The decoded values of the array of that name and type, whose byte count must be right.
template <typename T>
std::vector<T> arrayOf(const std::string& vtu, const std::string& type, const std::string& name) {
  const size_t tag = vtu.find("<DataArray type=\"" + type + "\" Name=\"" + name + "\"");
  REQUIRE(tag != std::string::npos);
  const size_t begin = vtu.find('>', tag) + 1;
  const std::string bytes = decodeBase64(vtu.substr(begin, vtu.find('<', begin) - begin));
  Bytes stream(bytes);
  REQUIRE(stream.take<uint32_t>() == bytes.size() - 4);
  std::vector<T> values;
  while (!stream.isAtEnd()) values.push_back(stream.take<T>());
  return values;
}

}  // namespace

TEST_CASE("VTU holds points, cells and fields as inline base64") {
  const std::string vtu = written(".vtu", tetrahedron(), sdfAndSeed({0.5, kNoValue, 2.25, 1}, {1, 0, 1, 0}));
  CHECK(vtu.find("header_type=\"UInt32\"") != std::string::npos);
  CHECK(vtu.find("<Piece NumberOfPoints=\"4\" NumberOfCells=\"4\">") != std::string::npos);
  CHECK(vtu.find("<CellData Scalars=\"sdf\">") != std::string::npos);
  CHECK(vtu.find("PointData") == std::string::npos);
  CHECK(vtu.ends_with("</VTKFile>\n"));
  CHECK(arrayOf<float>(vtu, "Float32", "Points") == std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1.5, 0, 0, 0, -2});
  CHECK(arrayOf<int32_t>(vtu, "Int32", "connectivity") == std::vector<int32_t>{0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2});
  CHECK(arrayOf<int32_t>(vtu, "Int32", "offsets") == std::vector<int32_t>{3, 6, 9, 12});
  CHECK(arrayOf<uint8_t>(vtu, "UInt8", "types") == std::vector<uint8_t>{5, 5, 5, 5});
  CHECK(arrayOf<float>(vtu, "Float32", "sdf") == std::vector<float>{0.5, 0, 2.25, 1});
  CHECK(arrayOf<uint8_t>(vtu, "UInt8", "seed") == std::vector<uint8_t>{1, 0, 1, 0});
}

TEST_CASE("VTU keeps polygons, also those with fewer than three corners") {
  const std::string vtu = written(".vtu", polygonMesh(), sdfAndSeed({1, 2, 3, kNoValue}, {1, 1, 1, 0}));
  CHECK(arrayOf<int32_t>(vtu, "Int32", "connectivity") ==
        std::vector<int32_t>{0, 1, 2, 3, 1, 4, 2, 0, 1, 4, 2, 5, 3, 5});
  CHECK(arrayOf<int32_t>(vtu, "Int32", "offsets") == std::vector<int32_t>{4, 7, 12, 14});
  CHECK(arrayOf<uint8_t>(vtu, "UInt8", "types") == std::vector<uint8_t>{7, 5, 7, 3});
}

TEST_CASE("VTU arrays longer than the buffer of the encoder are complete, at each remainder modulo 3") {
  for (const uint32_t count : {5000u, 5001u, 5002u}) {
    Mesh mesh = tetrahedron();
    mesh.faces.assign(count, {0, 1, 2});
    std::vector<double> values(count);
    for (uint32_t i = 0; i < count; ++i) values[i] = i * 0.5;
    const std::string vtu = written(".vtu", mesh, sdfAndSeed(values, std::vector<uint8_t>(count, 1)));
    const std::vector<float> read = arrayOf<float>(vtu, "Float32", "sdf");
    REQUIRE(read.size() == count);
    for (uint32_t i = 0; i < count; ++i) REQUIRE(read[i] == static_cast<float>(values[i]));
    CHECK(arrayOf<uint8_t>(vtu, "UInt8", "seed") == std::vector<uint8_t>(count, 1));
  }
}

TEST_CASE("VTU points beyond the precision of float are doubles") {
  Mesh mesh = tetrahedron();
  mesh.vertices[0].x = 1e7 + 0.1;
  const std::string vtu = written(".vtu", mesh, sdfAndSeed({1, 1, 1, 1}, {1, 1, 1, 1}));
  CHECK(arrayOf<double>(vtu, "Float64", "Points")[0] == 1e7 + 0.1);
}

TEST_CASE("VTU holds vertex fields, vectors and integers") {
  const std::string vtu =
      written(".vtu", tetrahedron(),
              {makeField("part", std::vector<uint32_t>{7, 0, 4000000000, 1}),
               makeField("axis", std::vector<double>{1, 2, 3, kNoValue, 5, 6, 7, 8, 9, 10, 11, 12},
                         FieldLocation::PerVertex, 3),
               makeField("angle", std::vector<double>{0.5, 1.5, 2.5, 3.5}, FieldLocation::PerVertex)});
  CHECK(vtu.find("<PointData Scalars=\"angle\">\n<DataArray type=\"Float32\" Name=\"axis\" "
                 "NumberOfComponents=\"3\" format=\"binary\">") != std::string::npos);
  CHECK(vtu.find("<CellData>\n<DataArray type=\"UInt32\" Name=\"part\" format=\"binary\">") != std::string::npos);
  CHECK(arrayOf<uint32_t>(vtu, "UInt32", "part") == std::vector<uint32_t>{7, 0, 4000000000, 1});
  CHECK(arrayOf<float>(vtu, "Float32", "axis") == std::vector<float>{1, 2, 3, 0, 5, 6, 7, 8, 9, 10, 11, 12});
  CHECK(arrayOf<float>(vtu, "Float32", "angle") == std::vector<float>{0.5, 1.5, 2.5, 3.5});
}
