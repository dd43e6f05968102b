#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "io/formats.h"
#include "reading.h"
#include "written_file.h"

using namespace asdfvk;
using asdfvk::test::holds;

namespace {

/// Entries that float32 holds exactly, with NaN and infinity.
std::vector<double> realValues(size_t count, Random& random) {
  std::vector<double> values(count);
  for (double& value : values) value = static_cast<double>(static_cast<float>(20 * random.real() - 10));
  if (count > 1) values[1] = kNoValue;
  if (count > 2) values[2] = -std::numeric_limits<double>::infinity();
  return values;
}

template <typename T>
std::vector<T> integerValues(size_t count, Random& random) {
  std::vector<T> values(count);
  for (T& value : values) value = static_cast<T>(random.next());
  if (count > 0) values[0] = std::numeric_limits<T>::max();
  return values;
}

/// A field of each type and number of components.
std::vector<Field> everyField(FieldLocation location, size_t itemCount, const std::string& prefix) {
  Random random(itemCount + prefix.size());
  std::vector<Field> fields;
  for (const uint32_t components : {1u, 3u}) {
    const size_t count = itemCount * components;
    const std::string suffix = "_" + std::to_string(components);
    fields.push_back(makeField(prefix + "real" + suffix, realValues(count, random), location, components));
    fields.push_back(makeField(prefix + "byte" + suffix, integerValues<uint8_t>(count, random), location, components));
    fields.push_back(makeField(prefix + "word" + suffix, integerValues<uint32_t>(count, random), location, components));
  }
  return fields;
}

std::vector<Field> everyField(const Mesh& mesh) {
  std::vector<Field> fields = everyField(FieldLocation::PerFace, mesh.inputFaceCount(), "f_");
  for (Field& field : everyField(FieldLocation::PerVertex, mesh.vertices.size(), "v_"))
    fields.push_back(std::move(field));
  return fields;
}

void requireSame(const Field& read, const Field& original) {
  CAPTURE(original.name);
  CHECK(read.name == original.name);
  CHECK(read.location == original.location);
  CHECK(read.componentCount == original.componentCount);
  CHECK(read.values.index() == original.values.index());
  REQUIRE(read.size() == original.size());
  size_t differentCount = 0;
  for (size_t i = 0; i < read.size(); ++i) {
    const double expected = std::isnan(original.at(i)) ? 0 : original.at(i);
    differentCount += read.at(i) == expected ? 0 : 1;
  }
  CHECK(differentCount == 0);
}

void requireRoundTrip(const Mesh& mesh, const std::vector<Field>& fields, bool ascii = false) {
  const Folder folder;
  const std::filesystem::path path = folder / "out.ply";
  writeResult(path, mesh, fields, {.format = {}, .ascii = ascii});
  const std::vector<Field> read = readFields(path);
  REQUIRE(read.size() == fields.size());
  for (const Field& field : read) {
    size_t i = 0;
    while (i + 1 < fields.size() && (fields[i].name != field.name || fields[i].location != field.location)) ++i;
    requireSame(field, fields[i]);
  }
}

/// The message of the Error{UnreadableInput} of reading the fields of a PLY; "no error" without one.
std::string errorOfFields(const std::string& ply) {
  try {
    static_cast<void>(formatOfExtension("ply")->parseFields(ply));
  } catch (const Error& error) {
    return error.code() == ErrorCode::UnreadableInput ? error.what() : "an error of another kind";
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const size_t at = text.find(part);
  REQUIRE(at != std::string::npos);
  return text.replace(at, part.size(), by);
}

}  // namespace

TEST_CASE("fields of every type and location survive writing and reading as PLY") {
  for (const Mesh& mesh : {tetrahedron(), polygonMesh()})
    for (const bool ascii : {false, true}) requireRoundTrip(mesh, everyField(mesh), ascii);
}

TEST_CASE("a face field and a vertex field may have one name, but no second name in NPZ") {
  const Mesh mesh = polygonMesh();
  std::vector<Field> fields = everyField(FieldLocation::PerFace, mesh.inputFaceCount(), "a_");
  for (Field& field : everyField(FieldLocation::PerVertex, mesh.vertices.size(), "a_"))
    fields.push_back(std::move(field));
  requireRoundTrip(mesh, fields);
  CHECK(holds(written(".npz", mesh, fields), "vertex_a_real_1.npy"));
  fields.push_back(makeField("vertex_a_real_1", std::vector<double>(mesh.inputFaceCount())));
  CHECK_THROWS_AS((void)written(".npz", mesh, fields), Error);
  requireRoundTrip(mesh, fields);
}

TEST_CASE("a name selects the fields of both locations") {
  const Mesh mesh = tetrahedron();
  const std::vector<Field> fields{makeField("a", std::vector<double>(4, 1)), makeField("b", std::vector<double>(4, 2)),
                                  makeField("a", std::vector<double>(4, 3), FieldLocation::PerVertex),
                                  makeField("b", std::vector<double>(4, 4), FieldLocation::PerVertex)};
  const Folder folder;
  writeResult(folder / "out.ply", mesh, fields, {.format = {}, .fields = {"b"}});
  const std::vector<Field> read = readFields(folder / "out.ply");
  REQUIRE(read.size() == 2);
  for (const Field& field : read) {
    CHECK(field.name == "b");
    CHECK(field.at(0) == (field.location == FieldLocation::PerFace ? 2 : 4));
  }
}

TEST_CASE("the fields of an empty mesh, and of none, are read") {
  requireRoundTrip(Mesh{}, sdfAndSeed({}, {}));
  requireRoundTrip(tetrahedron(), {});
}

TEST_CASE("the default fields are read in their order, without the colour") {
  const Folder folder;
  writeResult(folder / "out.ply", tetrahedron(), sdfAndSeed({0.5, 1, 2.25, 4}, {1, 0, 1, 0}));
  const std::vector<Field> fields = readFields(folder / "out.ply");
  REQUIRE(fields.size() == 2);
  CHECK(fields[0].name == "sdf");
  CHECK(*fields[0].reals() == std::vector<double>{0.5, 1, 2.25, 4});
  CHECK(fields[1].name == "seed");
}

TEST_CASE("the numbers of a PLY of another program are its fields") {
  const std::string ply =
      "ply\nformat ascii 1.0\ncomment of another program\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty short height\nelement face 1\nproperty int part\n"
      "property list uchar int vertex_indices\nproperty ushort quality\nend_header\n"
      "0 0 0 255 -7\n1 0 0 0 8\n0 1 0 1 9\n-3 3 0 1 2 65535\n";
  const std::vector<Field> fields = formatOfExtension("ply")->parseFields(ply);
  REQUIRE(fields.size() == 4);
  CHECK(fields[0].name == "red");
  CHECK(fields[0].values == Field::Values(std::vector<uint8_t>{255, 0, 1}));
  CHECK(fields[1].name == "height");
  CHECK(fields[1].values == Field::Values(std::vector<double>{-7, 8, 9}));
  CHECK(fields[1].location == FieldLocation::PerVertex);
  CHECK(fields[2].name == "part");
  CHECK(fields[2].values == Field::Values(std::vector<double>{-3}));
  CHECK(fields[3].name == "quality");
  CHECK(fields[3].values == Field::Values(std::vector<uint32_t>{65535}));
  CHECK(fields[3].location == FieldLocation::PerFace);
  for (const char* number : {"256", "-1", "0.5", "nan"})
    CHECK(holds(errorOfFields(replaced(ply, "255", number)), "line 15: " + std::string(number)));
}

TEST_CASE("every truncation of a file with fields is an error, and so is a byte after its end") {
  for (const bool ascii : {false, true}) {
    const std::string whole = written(".ply", tetrahedron(), everyField(tetrahedron()), {.format = {}, .ascii = ascii});
    CHECK(errorOfFields(whole) == "no error");
    for (size_t size = 0; size < whole.size(); ++size) {
      CAPTURE(size);
      CHECK(errorOfFields(whole.substr(0, size)) != "no error");
    }
    CHECK(errorOfFields(whole + "x") != "no error");
  }
}

TEST_CASE("a file without fields is an error that names its format") {
  const Folder folder;
  putContent(folder / "mesh.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const auto errorOfReading = [](const auto& read) -> std::string {
    try {
      static_cast<void>(read());
    } catch (const Error& error) {
      return error.code() == ErrorCode::UnreadableInput ? error.what() : "an error of another kind";
    }
    return "no error";
  };
  CHECK(holds(errorOfReading([&] { return readFields(folder / "mesh.off"); }),
              "mesh.off: has the format off; fields are read from ply"));
  CHECK(holds(errorOfReading([&] { return readFields(folder / "missing.csv"); }), "missing.csv: cannot be opened"));
  writeResult(folder / "out.vtu", tetrahedron(), {});
  CHECK(holds(errorOfReading([&] { return readMesh(folder / "out.vtu"); }),
              "has the format vtu; meshes are read from stl, ply, off or obj"));
}
