#include <doctest/doctest.h>

#include <cmath>

#include "written_file.h"

using namespace asdfvk;

TEST_CASE("CSV has a row per input face, nan for no value, and the shortest exact numbers") {
  const std::string csv = written(".csv", tetrahedron(), {0.1, -kNoValue, 1.0 / 3, 2}, {1, 0, 0, 1});
  CHECK(csv == "face,sdf,seed\n0,0.1,1\n1,nan,0\n2,0.3333333333333333,0\n3,2,1\n");
}

TEST_CASE("CSV and NPY of polygons count input faces, not triangles") {
  CHECK(written(".csv", polygonMesh(), {1, 2, 3, kNoValue}, {1, 1, 1, 0}) ==
        "face,sdf,seed\n0,1,1\n1,2,1\n2,3,1\n3,nan,0\n");
  CHECK(written(".npy", polygonMesh(), {1, 2, 3, kNoValue}, {1, 1, 1, 0}).find("'shape': (4,)") != std::string::npos);
}

TEST_CASE("NPY is the exact bytes of a one-dimensional little-endian float32 array") {
  const std::string npy = written(".npy", tetrahedron(), {0.5, kNoValue, 2.25, 1}, {1, 0, 1, 0});
  std::string expected("\x93NUMPY\x01\x00\x76\x00", 10);
  expected += "{'descr': '<f4', 'fortran_order': False, 'shape': (4,), }";
  expected.resize(127, ' ');
  expected += '\n';
  REQUIRE(npy.size() == expected.size() + 16);
  CHECK(npy.substr(0, 128) == expected);
  Bytes bytes(std::string_view(npy).substr(128));
  CHECK(bytes.take<float>() == 0.5f);
  CHECK(bytes.take<uint32_t>() == 0x7fc00000u);  // the quiet NaN
  CHECK(bytes.take<float>() == 2.25f);
  CHECK(bytes.take<float>() == 1.0f);
}

TEST_CASE("NPY data start at a multiple of 64 whatever the count's digits, an empty mesh included") {
  for (const size_t count : {0, 1, 10, 1000, 123456}) {
    Mesh mesh = tetrahedron();
    mesh.faces.assign(count, {0, 1, 2});
    const std::string npy = written(".npy", mesh, std::vector<double>(count, 1), std::vector<uint8_t>(count, 1));
    const size_t headerSize = static_cast<uint8_t>(npy[8]) + 256u * static_cast<uint8_t>(npy[9]);
    CHECK((10 + headerSize) % 64 == 0);
    CHECK(npy[10 + headerSize - 1] == '\n');
    CHECK(npy.size() == 10 + headerSize + 4 * count);
  }
}
