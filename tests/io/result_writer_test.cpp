#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <functional>
#include <optional>

#include "asdf_vk/error.h"
#include "written_file.h"

using namespace asdfvk;

namespace {

const std::vector<Field> kFaceFields = sdfAndSeed({1, 2, 3, 4}, {1, 0, 0, 1});

std::optional<ErrorCode> codeOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code();
  }
  return std::nullopt;
}

/// Requires that no format is written with these fields, and that no file is left.
void requireRejected(const std::vector<Field>& fields) {
  for (const std::string& format : resultFormats()) {
    CAPTURE(format);
    const Folder folder;
    CHECK(codeOf([&] { writeResult(folder / ("out." + format), tetrahedron(), fields); }) == ErrorCode::OptionConflict);
    CHECK(folder.names().empty());
  }
}

}  // namespace

TEST_CASE("numbers that do not fit into float32 are refused, except by CSV") {
  for (const std::string& format : resultFormats()) {
    CAPTURE(format);
    const Folder folder;
    const auto write = [&] {
      writeResult(folder / ("out." + format), tetrahedron(), sdfAndSeed({1, 2, 1e39, 4}, {1, 0, 0, 1}));
    };
    if (format == "csv") {
      CHECK_NOTHROW(write());
    } else {
      CHECK(codeOf(write) == ErrorCode::ValueOutOfRange);
      CHECK(folder.names().empty());
    }
  }
}

TEST_CASE("the options decide the format, then the extension in any case") {
  CHECK(resultFormats() == std::vector<std::string>{"ply", "obj", "glb", "vtu", "npy", "npz", "csv"});
  CHECK(resultFormatOf("a.ply") == "ply");
  CHECK(resultFormatOf("a.b.VTU") == "vtu");
  CHECK(resultFormatOf("dir.csv/a.NpY") == "npy");
  CHECK(resultFormatOf("a.ply", {.format = "csv"}) == "csv");
  CHECK(resultFormatOf("-", {.format = "npz"}) == "npz");
}

TEST_CASE("an unknown format is an error that lists the formats") {
  for (const char* path : {"a.stl", "a", "ply", ".ply", "", "-", "a.ply.gz"}) {
    CAPTURE(path);
    CHECK(codeOf([&] { (void)resultFormatOf(path); }) == ErrorCode::UnknownFormat);
  }
  for (const char* name : {"off", "PNG", "?"})
    CHECK(codeOf([&] { (void)resultFormatOf("a.ply", {.format = name}); }) == ErrorCode::UnknownFormat);
  try {
    (void)resultFormatOf("-");
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find("ply, obj, glb, vtu, npy, npz or csv") != std::string::npos);
  }
}

TEST_CASE("a minus sign writes the named format to standard output") {
  const Folder folder;
  const int saved = ::dup(STDOUT_FILENO);
  const int file = ::open((folder / "stdout").c_str(), O_WRONLY | O_CREAT, 0600);
  ::dup2(file, STDOUT_FILENO);
  writeResult("-", tetrahedron(), kFaceFields, {.format = "csv"});
  ::dup2(saved, STDOUT_FILENO);
  ::close(file);
  ::close(saved);
  CHECK(contentOf(folder / "stdout") == "face,sdf,seed\n0,1,1\n1,2,0\n2,3,0\n3,4,1\n");
  CHECK(!std::filesystem::exists("-"));
}

TEST_CASE("fields that do not fit the mesh are rejected by every format before a file exists") {
  requireRejected({makeField("sdf", std::vector<double>{1, 2, 3})});
  requireRejected({makeField("sdf", std::vector<double>{1, 2, 3, 4, 5})});
  requireRejected({makeField("p", std::vector<double>(4), FieldLocation::PerFace, 3)});
  requireRejected({makeField("p", std::vector<double>(12), FieldLocation::PerVertex, 1)});
  requireRejected({makeField("p", std::vector<double>(8), FieldLocation::PerFace, 2)});
  requireRejected({makeField("p", std::vector<double>(), FieldLocation::PerFace, 0)});
}

TEST_CASE("invalid and repeated names of fields are rejected by every format") {
  const std::vector<double> values(4);
  for (const char* name : {"", "a b", "a,b", "a.b", "\"", "<", "\xc3\xa4", "a\n"}) {
    CAPTURE(name);
    requireRejected({makeField(name, values)});
  }
  requireRejected({makeField("a", values), makeField("b", values), makeField("a", values)});
  requireRejected({makeField("a", values, FieldLocation::PerVertex), makeField("a", values, FieldLocation::PerVertex)});
}

TEST_CASE("the options choose the fields to write and their order") {
  const auto names = [](const std::vector<std::string>& chosen) {
    const std::string csv = written(".csv", tetrahedron(), kFaceFields, {.format = {}, .fields = chosen});
    return csv.substr(0, csv.find('\n'));
  };
  CHECK(names({}) == "face,sdf,seed");
  CHECK(names({"seed"}) == "face,seed");
  CHECK(names({"seed", "sdf"}) == "face,seed,sdf");
  const Folder folder;
  const auto write = [&](const std::vector<std::string>& chosen) {
    return codeOf(
        [&] { writeResult(folder / "out.ply", tetrahedron(), kFaceFields, {.format = {}, .fields = chosen}); });
  };
  CHECK(write({"sdf", "error"}) == ErrorCode::UnknownField);
  CHECK(write({"sdf", "sdf"}) == ErrorCode::OptionConflict);
  CHECK(folder.names().empty());
}

TEST_CASE("a name chooses the fields of both locations") {
  std::vector<Field> fields;
  for (const FieldLocation location : {FieldLocation::PerFace, FieldLocation::PerVertex})
    for (const char* name : {"a", "b"}) fields.push_back(makeField(name, std::vector<uint8_t>(4, 1), location));
  const std::string ply = written(".ply", tetrahedron(), fields, {.format = {}, .fields = {"b"}});
  for (const char* end : {"element face", "end_header"})
    CHECK(ply.find(std::string("property uchar b\n") + end) != std::string::npos);
  CHECK(ply.find("property uchar a\n") == std::string::npos);
}

TEST_CASE("names that a format uses itself, or two columns of one name, are rejected by this format only") {
  const auto write = [](const std::string& extension, const std::vector<Field>& fields) {
    return codeOf([&] { (void)written(extension, tetrahedron(), fields); });
  };
  const Field sdf = makeField("sdf", std::vector<double>(4));
  for (const char* name : {"quality", "red", "alpha", "vertex_indices"}) {
    const Field reserved = makeField(name, std::vector<uint8_t>(4));
    CHECK(write(".ply", {sdf, reserved}) == ErrorCode::OptionConflict);
    CHECK(!write(".csv", {sdf, reserved}));
  }
  CHECK(!write(".ply", {makeField("quality", std::vector<double>(4))}));
  CHECK(!write(".ply", {makeField("quality", std::vector<double>(4), FieldLocation::PerVertex)}));
  CHECK(write(".ply", {sdf, makeField("x", std::vector<uint8_t>(4), FieldLocation::PerVertex)}) ==
        ErrorCode::OptionConflict);
  CHECK(write(".csv", {makeField("face", std::vector<double>(4))}) == ErrorCode::OptionConflict);
  const std::vector<Field> columns{makeField("p", std::vector<double>(12), FieldLocation::PerFace, 3),
                                   makeField("p_y", std::vector<uint8_t>(4))};
  CHECK(write(".ply", columns) == ErrorCode::OptionConflict);
  CHECK(write(".csv", columns) == ErrorCode::OptionConflict);
  CHECK(!write(".vtu", columns));
  CHECK(!write(".npz", columns));
}

TEST_CASE("arrays of a caller give the same files as the mesh") {
  const Mesh mesh = tetrahedron(), polygons = polygonMesh();
  std::vector<float> positions;
  for (const Vec3d& p : mesh.vertices)
    for (size_t axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(p[axis]));
  std::vector<uint32_t> corners;
  for (const Face& face : mesh.faces) corners.insert(corners.end(), face.begin(), face.end());
  const MeshView view{std::span<const float>(positions), corners};
  const MeshView polygonView{std::span<const double>(&polygons.vertices[0].x, 3 * polygons.vertices.size()),
                             polygons.polygons.corners, polygons.polygons.firstCorner};
  for (const std::string& format : resultFormats()) {
    CHECK(written("." + format, view, kFaceFields) == written("." + format, mesh, kFaceFields));
    CHECK(written("." + format, polygonView, kFaceFields) == written("." + format, polygons, kFaceFields));
  }
}

TEST_CASE("a face with an index out of range, and offsets that do not ascend, are errors") {
  Mesh mesh = tetrahedron();
  mesh.faces[2][1] = 4;
  CHECK(codeOf([&] { (void)written(".ply", mesh, kFaceFields); }) == ErrorCode::IndexOutOfRange);
  Mesh polygons = polygonMesh();
  for (const std::vector<uint64_t>& first :
       {std::vector<uint64_t>{0, 4, 3, 12, 14}, {1, 4, 7, 12, 14}, {0, 4, 7, 12, 15}}) {
    polygons.polygons.firstCorner = first;
    CHECK(codeOf([&] { (void)written(".vtu", polygons, kFaceFields); }) == ErrorCode::ArraySize);
  }
}

TEST_CASE("an empty mesh is written in every format") {
  for (const std::string& format : resultFormats()) CHECK(!written("." + format, Mesh{}, sdfAndSeed({}, {})).empty());
  CHECK(written(".csv", Mesh{}, sdfAndSeed({}, {})) == "face,sdf,seed\n");
}
