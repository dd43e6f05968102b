#include <doctest/doctest.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cmath>
#include <sstream>

#include "io/colour_map.h"
#include "io/formats.h"
#include "written_file.h"

using namespace asdfvk;

namespace {

struct SplitPly {
  std::string header, body;
};
SplitPly split(const std::string& ply) {
  const size_t end = ply.find("end_header\n") + 11;
  return {ply.substr(0, end), ply.substr(end)};
}
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::vector<double> kValues{0.5, kNoValue, 2.25, 1};
const std::vector<uint8_t> kSeeds{1, 0, 1, 0};
const std::vector<Field> kFields = sdfAndSeed(kValues, kSeeds);

}  // namespace

TEST_CASE("binary PLY holds the vertices, then per face the list, the quality, its colour and the other fields") {
  const Mesh mesh = tetrahedron();
  const auto [header, body] = split(written(".ply", mesh, kFields));
  CHECK(header ==
        "ply\nformat binary_little_endian 1.0\n"
        "comment asdf-vk: quality is sdf, 0 (and grey) where there is no value\n"
        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 4\nproperty list uchar int vertex_indices\nproperty float quality\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty uchar seed\n"
        "end_header\n");
  Bytes bytes(body);
  for (const Vec3d& p : mesh.vertices)
    for (size_t axis = 0; axis < 3; ++axis) CHECK(bytes.take<float>() == static_cast<float>(p[axis]));
  for (size_t f = 0; f < 4; ++f) {
    CHECK(bytes.take<uint8_t>() == 3);
    for (const uint32_t corner : mesh.faces[f]) CHECK(bytes.take<int32_t>() == static_cast<int32_t>(corner));
    CHECK(bytes.take<float>() == (f == 1 ? 0.0f : static_cast<float>(kValues[f])));
    const Rgba colour{bytes.take<uint8_t>(), bytes.take<uint8_t>(), bytes.take<uint8_t>(), bytes.take<uint8_t>()};
    if (f == 0) CHECK(colour == Rgba{68, 1, 84, 255});
    if (f == 1) CHECK(colour == Rgba{128, 128, 128, 255});
    if (f == 2) CHECK(colour == Rgba{253, 231, 37, 255});
    CHECK(bytes.take<uint8_t>() == kSeeds[f]);
  }
  CHECK(bytes.isAtEnd());
}

TEST_CASE("ascii PLY holds the same rows as words") {
  const auto [header, body] = split(written(".PLY", tetrahedron(), kFields, {.format = {}, .ascii = true}));
  CHECK(contains(header, "format ascii 1.0\n"));
  std::istringstream lines(body);
  std::string line;
  std::vector<std::string> rows;
  while (std::getline(lines, line)) rows.push_back(line);
  REQUIRE(rows.size() == 8);
  CHECK(rows[2] == "0 1.5 0");
  CHECK(rows[3] == "0 0 -2");
  CHECK(rows[4] == "3 0 1 2 0.5 68 1 84 255 1");
  CHECK(rows[5] == "3 0 3 1 0 128 128 128 255 0");
  CHECK(rows[6] == "3 0 2 3 2.25 253 231 37 255 1");
}

TEST_CASE("PLY keeps the polygons of the input") {
  const std::vector<double> values{1, 2, 3, kNoValue};
  const auto [header, body] = split(written(".ply", polygonMesh(), sdfAndSeed(values, kSeeds)));
  CHECK(contains(header, "element face 4\nproperty list uchar int"));
  Bytes bytes(body);
  for (int i = 0; i < 18; ++i) (void)bytes.take<float>();
  const std::vector<std::vector<int32_t>> expected{{0, 1, 2, 3}, {1, 4, 2}, {0, 1, 4, 2, 5}, {3, 5}};
  for (size_t f = 0; f < 4; ++f) {
    REQUIRE(bytes.take<uint8_t>() == expected[f].size());
    for (const int32_t corner : expected[f]) CHECK(bytes.take<int32_t>() == corner);
    CHECK(bytes.take<float>() == (f == 3 ? 0.0f : static_cast<float>(values[f])));
    (void)bytes.take<uint32_t>();
    CHECK(bytes.take<uint8_t>() == kSeeds[f]);
  }
  CHECK(bytes.isAtEnd());
}

TEST_CASE("a polygon of more than 255 corners makes the PLY list count an int") {
  for (const uint32_t count : {255u, 256u}) {
    Mesh mesh;
    for (uint32_t v = 0; v < count; ++v) mesh.vertices.push_back({double(v), 0, 0});
    for (uint32_t v = 0; v < count; ++v) mesh.polygons.corners.push_back(v);
    mesh.polygons.firstCorner = {0, count};
    const auto [header, body] = split(written(".ply", mesh, {makeField("sdf", std::vector<double>{1})}));
    CHECK(contains(header, count == 255 ? "list uchar int" : "list int int"));
    Bytes bytes(body);
    for (uint32_t i = 0; i < 3 * count; ++i) (void)bytes.take<float>();
    CHECK((count == 255 ? bytes.take<uint8_t>() : bytes.take<uint32_t>()) == count);
    CHECK(body.size() == 12 * count + (count == 255 ? 1 : 4) + 4 * count + 8);
  }
}

TEST_CASE("vertices beyond the precision of float are written as double; non-finite ones stay float") {
  Mesh mesh = tetrahedron();
  mesh.vertices[1].x = std::numeric_limits<double>::infinity();
  mesh.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
  CHECK(contains(written(".ply", mesh, kFields), "property float x"));
  mesh.vertices[3].z = 0.1;
  const auto [header, body] = split(written(".ply", mesh, kFields));
  CHECK(contains(header, "property double x\nproperty double y\nproperty double z\n"));
  Bytes bytes(body);
  for (int i = 0; i < 3; ++i) CHECK(bytes.take<double>() == 0);
  CHECK(bytes.take<double>() == std::numeric_limits<double>::infinity());
  for (int i = 0; i < 3; ++i) (void)bytes.take<double>();
  CHECK(std::isnan(bytes.take<double>()));
  for (int i = 0; i < 3; ++i) (void)bytes.take<double>();
  CHECK(bytes.take<double>() == 0.1);
}

TEST_CASE("OpenMesh reads the faces and vertices of our PLY, ascii and binary") {
  struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
  };
  const Mesh mesh = tetrahedron();
  for (const bool ascii : {false, true}) {
    const Folder folder;
    writeResult(folder / "out.ply", mesh, kFields, {.format = {}, .ascii = ascii});
    OpenMesh::TriMesh_ArrayKernelT<Traits> read;
    REQUIRE(OpenMesh::IO::read_mesh(read, (folder / "out.ply").string()));
    REQUIRE(read.n_vertices() == 4);
    REQUIRE(read.n_faces() == 4);
    for (const auto vertex : read.vertices()) {
      const Vec3d& p = mesh.vertices[static_cast<size_t>(vertex.idx())];
      CHECK(read.point(vertex) == OpenMesh::Vec3d(p.x, p.y, p.z));
    }
    for (const auto face : read.faces()) {
      const Face& expected = mesh.faces[static_cast<size_t>(face.idx())];
      std::vector<uint32_t> corners;
      for (const auto vertex : face.vertices()) corners.push_back(static_cast<uint32_t>(vertex.idx()));
      std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), expected[0]), corners.end());
      CHECK(std::equal(corners.begin(), corners.end(), expected.begin(), expected.end()));
    }
  }
}

TEST_CASE("PLY holds vertex fields after the coordinates and every type of face field after the colour") {
  const std::vector<Field> fields{
      makeField("part", std::vector<uint32_t>{7, 0, 4000000000, 1}),
      makeField("axis", std::vector<double>{1, 2, 3, kNoValue, 5, 6, 7, 8, 9, 10, 11, 12}, FieldLocation::PerFace, 3),
      makeField("angle", std::vector<double>{0.5, 1.5, 2.5, 3.5}, FieldLocation::PerVertex),
      makeField("error", std::vector<double>{0.25, 0, 0, 0}),
      makeField("flags", std::vector<uint8_t>{0, 255, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, FieldLocation::PerVertex, 3),
  };
  const auto [header, body] = split(written(".ply", tetrahedron(), fields, {.format = {}, .ascii = true}));
  CHECK(contains(header,
                 "comment asdf-vk: quality is error, 0 (and grey) where there is no value\n"
                 "comment asdf-vk: quality of vertices is angle, 0 (and grey) where there is no value\n"
                 "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float quality\n"
                 "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                 "property uchar flags_x\nproperty uchar flags_y\nproperty uchar flags_z\n"
                 "element face 4\nproperty list uchar int vertex_indices\nproperty float quality\n"
                 "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                 "property uint part\nproperty float axis_x\nproperty float axis_y\nproperty float axis_z\n"));
  CHECK(body.starts_with("0 0 0 0.5 68 1 84 255 0 255 1\n1 0 0 1.5 49 103 141 255 2 3 4\n"));
  CHECK(contains(body,
                 "\n3 0 1 2 0.25 253 231 37 255 7 1 2 3\n3 0 3 1 0 68 1 84 255 0 0 5 6\n3 0 2 3 0 68 1 84 255 "
                 "4000000000 7 8 9\n"));
}

TEST_CASE("PLY without a real face field has neither quality nor colour") {
  const auto [header, body] =
      split(written(".ply", tetrahedron(), {makeField("seed", kSeeds)}, {.format = {}, .ascii = true}));
  CHECK(header.ends_with("element face 4\nproperty list uchar int vertex_indices\nproperty uchar seed\nend_header\n"));
  CHECK(!contains(header, "comment"));
  CHECK(body.ends_with("3 0 1 2 1\n3 0 3 1 0\n3 0 2 3 1\n3 1 3 2 0\n"));
  CHECK(split(written(".ply", tetrahedron(), {}, {.format = {}, .ascii = true})).body.ends_with("3 1 3 2\n"));
}

TEST_CASE("the comment of a PLY has the label of the field") {
  Field sdf = makeField("sdf", kValues);
  sdf.label = "shape diameter";
  const std::string ply = written(".ply", tetrahedron(), {sdf});
  CHECK(contains(ply, "comment asdf-vk: quality is sdf (shape diameter), 0 (and grey) where there is no value\n"));
}
