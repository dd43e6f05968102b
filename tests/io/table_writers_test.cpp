#include <doctest/doctest.h>
#include <zlib.h>

#include <cmath>

#include "asdf_vk/error.h"
#include "written_file.h"

using namespace asdfvk;

TEST_CASE("CSV has a row per input face, nan for no value, and the shortest exact numbers") {
  const std::string csv = written(".csv", tetrahedron(), sdfAndSeed({0.1, -kNoValue, 1.0 / 3, 2}, {1, 0, 0, 1}));
  CHECK(csv == "face,sdf,seed\n0,0.1,1\n1,nan,0\n2,0.3333333333333333,0\n3,2,1\n");
}

TEST_CASE("CSV and NPY of polygons have an entry per input face") {
  CHECK(written(".csv", polygonMesh(), sdfAndSeed({1, 2, 3, kNoValue}, {1, 1, 1, 0})) ==
        "face,sdf,seed\n0,1,1\n1,2,1\n2,3,1\n3,nan,0\n");
  CHECK(written(".npy", polygonMesh(), sdfAndSeed({1, 2, 3, kNoValue}, {1, 1, 1, 0})).find("'shape': (4,)") !=
        std::string::npos);
}

TEST_CASE("NPY is the exact bytes of a one-dimensional little-endian float32 array") {
  const std::string npy = written(".npy", tetrahedron(), sdfAndSeed({0.5, kNoValue, 2.25, 1}, {1, 0, 1, 0}));
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

TEST_CASE("NPY entries start at a multiple of 64 bytes for counts of any length, 0 included") {
  for (const size_t count : {0, 1, 10, 1000, 123456}) {
    Mesh mesh = tetrahedron();
    mesh.faces.assign(count, {0, 1, 2});
    const std::string npy =
        written(".npy", mesh, sdfAndSeed(std::vector<double>(count, 1), std::vector<uint8_t>(count, 1)));
    const size_t headerSize = static_cast<uint8_t>(npy[8]) + 256u * static_cast<uint8_t>(npy[9]);
    CHECK((10 + headerSize) % 64 == 0);
    CHECK(npy[10 + headerSize - 1] == '\n');
    CHECK(npy.size() == 10 + headerSize + 4 * count);
  }
}

TEST_CASE("CSV has the face fields in their order, vectors as three columns") {
  const std::string csv =
      written(".csv", tetrahedron(),
              {makeField("axis", std::vector<double>{1, 2, 3, kNoValue, 5, 6, 7, 8, 9, 10, 11, 1e300},
                         FieldLocation::PerFace, 3),
               makeField("part", std::vector<uint32_t>{7, 0, 4000000000, 1}),
               makeField("flag", std::vector<uint8_t>{0, 255, 1, 10})});
  CHECK(csv ==
        "face,axis_x,axis_y,axis_z,part,flag\n0,1,2,3,7,0\n1,nan,5,6,0,255\n2,7,8,9,4000000000,1\n"
        "3,10,11,1e+300,1,10\n");
}

TEST_CASE("CSV has rows of vertices where all fields are per vertex, and rejects fields of both kinds") {
  const Field angle = makeField("angle", std::vector<double>{0.5, 1, 2, 3}, FieldLocation::PerVertex);
  CHECK(written(".csv", tetrahedron(), {angle}) == "vertex,angle\n0,0.5\n1,1\n2,2\n3,3\n");
  try {
    (void)written(".csv", tetrahedron(), {makeField("seed", std::vector<uint8_t>{1, 0, 1, 0}), angle});
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::OptionConflict);
    CHECK(std::string(error.what()).find("angle is per vertex and field seed per face") != std::string::npos);
  }
}

TEST_CASE("NPY has the type and the components of the first field") {
  const auto headerOf = [](const Field& field) { return written(".npy", tetrahedron(), {field}).substr(10, 60); };
  CHECK(headerOf(makeField("a", std::vector<uint8_t>{1, 2, 3, 4}))
            .starts_with("{'descr': '|u1', 'fortran_order': "
                         "False, 'shape': (4,), }"));
  CHECK(headerOf(makeField("a", std::vector<uint32_t>(12, 5), FieldLocation::PerVertex, 3))
            .starts_with("{'descr': '<u4', 'fortran_order': False, 'shape': (4, 3), }"));
  CHECK(written(".npy", tetrahedron(), {makeField("a", std::vector<uint8_t>{1, 2, 3, 4})}).ends_with("\1\2\3\4"));
  CHECK_THROWS_AS((void)written(".npy", tetrahedron(), {}), Error);
}

TEST_CASE("NPZ is a stored zip archive with a .npy per field") {
  const std::vector<Field> fields{makeField("sdf", std::vector<double>{0.5, kNoValue, 2.25, 1}),
                                  makeField("id", std::vector<uint32_t>{5, 6, 7, 8}, FieldLocation::PerVertex)};
  const std::string npz = written(".npz", tetrahedron(), fields);
  Bytes bytes(npz);
  for (const Field& field : fields) {
    const std::string npy = written(".npy", tetrahedron(), {field});
    CHECK(bytes.take<uint32_t>() == 0x04034b50);
    CHECK(bytes.take<uint16_t>() == 20);
    for (int i = 0; i < 3; ++i) CHECK(bytes.take<uint16_t>() == 0);
    CHECK(bytes.take<uint16_t>() == 0x21);
    CHECK(bytes.take<uint32_t>() == ::crc32_z(0, reinterpret_cast<const Bytef*>(npy.data()), npy.size()));
    CHECK(bytes.take<uint32_t>() == npy.size());
    CHECK(bytes.take<uint32_t>() == npy.size());
    CHECK(bytes.take<uint16_t>() == field.name.size() + 4);
    CHECK(bytes.take<uint16_t>() == 0);
    for (const char c : field.name + ".npy" + npy) REQUIRE(bytes.take<char>() == c);
  }
  CHECK(bytes.take<uint32_t>() == 0x02014b50);
  CHECK(npz.find("sdf.npyface") != std::string::npos);
  CHECK(npz.find("id.npyvertex") != std::string::npos);
  CHECK(npz == written(".npz", tetrahedron(), fields));
  CHECK(written(".npz", tetrahedron(), {}).size() == 22);
}

TEST_CASE("NPZ renames a vertex field with the name of a face field, unless another field has that name") {
  std::vector<Field> fields{makeField("a", std::vector<double>(4)),
                            makeField("a", std::vector<double>(4), FieldLocation::PerVertex)};
  CHECK(written(".npz", tetrahedron(), fields).find("vertex_a.npyvertex a") != std::string::npos);
  fields.push_back(makeField("vertex_a", std::vector<double>(4)));
  CHECK_THROWS_AS((void)written(".npz", tetrahedron(), fields), Error);
}
