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

struct Stored {
  bool hasNan = false;    ///< Else no value is read back as 0.
  bool hasTypes = false;  ///< Else every field is real.
  bool hasNames = false;
};
Stored storedBy(const std::string& format) {
  if (format == "ply" || format == "vtu") return {.hasNan = false, .hasTypes = true, .hasNames = true};
  if (format == "csv") return {.hasNan = true, .hasTypes = false, .hasNames = true};
  return {.hasNan = true, .hasTypes = true, .hasNames = format == "npz"};
}

void requireSame(const Field& read, const Field& original, const Stored& stored) {
  CAPTURE(original.name);
  CHECK(read.name == (stored.hasNames ? original.name : "values"));
  if (stored.hasNames) CHECK(read.location == original.location);
  CHECK(read.componentCount == original.componentCount);
  CHECK(read.values.index() == (stored.hasTypes ? original.values.index() : 0));
  REQUIRE(read.size() == original.size());
  size_t differentCount = 0;
  for (size_t i = 0; i < read.size(); ++i) {
    const double expected = std::isnan(original.at(i)) && !stored.hasNan ? 0 : original.at(i);
    differentCount += read.at(i) == expected || (std::isnan(read.at(i)) && std::isnan(expected)) ? 0 : 1;
  }
  CHECK(differentCount == 0);
}

void requireRoundTrip(const std::string& extension, const Mesh& mesh, const std::vector<Field>& fields,
                      const WriteOptions& options = {}) {
  CAPTURE(extension);
  const Folder folder;
  const std::filesystem::path path = folder / ("out." + extension);
  writeResult(path, mesh, fields, options);
  const std::vector<Field> read = readFields(path);
  REQUIRE(read.size() == fields.size());
  for (const Field& field : read) {
    size_t i = 0;
    while (i + 1 < fields.size() && (fields[i].name != field.name || fields[i].location != field.location)) ++i;
    requireSame(field, fields[i], storedBy(extension));
  }
}

/// The message of the Error{UnreadableInput} of reading `content` as that format; "no error" without one.
std::string errorOfFields(const std::string& extension, const std::string& content) {
  try {
    static_cast<void>(formatOfExtension(extension)->parseFields(content));
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

TEST_CASE("fields of every type and location survive writing and reading as PLY, VTU and NPZ") {
  for (const Mesh& mesh : {tetrahedron(), polygonMesh()}) {
    const std::vector<Field> fields = everyField(mesh);
    for (const char* format : {"ply", "vtu", "npz"}) requireRoundTrip(format, mesh, fields);
    requireRoundTrip("ply", mesh, fields, {.format = {}, .ascii = true});
  }
}

TEST_CASE("a face field and a vertex field may have one name") {
  const Mesh mesh = polygonMesh();
  std::vector<Field> fields = everyField(FieldLocation::PerFace, mesh.inputFaceCount(), "a_");
  for (Field& field : everyField(FieldLocation::PerVertex, mesh.vertices.size(), "a_"))
    fields.push_back(std::move(field));
  for (const char* format : {"ply", "vtu", "npz"}) requireRoundTrip(format, mesh, fields);
  // In NPZ the vertex field has another name, which no other field may have.
  const std::string npz = written(".npz", mesh, fields);
  CHECK(holds(npz, "vertex_a_real_1.npy"));
  fields.push_back(makeField("vertex_a_real_1", std::vector<double>(mesh.inputFaceCount())));
  CHECK_THROWS_AS((void)written(".npz", mesh, fields), Error);
  requireRoundTrip("vtu", mesh, fields);
}

TEST_CASE("a name selects the fields of both locations") {
  const Mesh mesh = tetrahedron();
  const std::vector<Field> fields{makeField("a", std::vector<double>(4, 1)), makeField("b", std::vector<double>(4, 2)),
                                  makeField("a", std::vector<double>(4, 3), FieldLocation::PerVertex),
                                  makeField("b", std::vector<double>(4, 4), FieldLocation::PerVertex)};
  const Folder folder;
  writeResult(folder / "out.vtu", mesh, fields, {.format = {}, .fields = {"b"}});
  const std::vector<Field> read = readFields(folder / "out.vtu");
  REQUIRE(read.size() == 2);
  for (const Field& field : read) {
    CHECK(field.name == "b");
    CHECK(field.at(0) == (field.location == FieldLocation::PerFace ? 2 : 4));
  }
}

TEST_CASE("face fields or vertex fields survive writing and reading as CSV, each field as NPY") {
  const Mesh mesh = polygonMesh();
  for (const FieldLocation location : {FieldLocation::PerFace, FieldLocation::PerVertex}) {
    const size_t itemCount = location == FieldLocation::PerFace ? mesh.inputFaceCount() : mesh.vertices.size();
    const std::vector<Field> fields = everyField(location, itemCount, "a_");
    requireRoundTrip("csv", mesh, fields);
    for (const Field& field : fields) requireRoundTrip("npy", mesh, {field});
  }
  // CSV holds double exactly.
  requireRoundTrip("csv", tetrahedron(), {makeField("a", std::vector<double>{0.1, 1.0 / 3, 1e-320, -1.7e308})});
}

TEST_CASE("the fields of an empty mesh, and of none, are read") {
  for (const char* format : {"ply", "vtu", "npz", "csv"}) {
    requireRoundTrip(format, Mesh{}, sdfAndSeed({}, {}));
    requireRoundTrip(format, tetrahedron(), {});
  }
}

TEST_CASE("the default fields are read in their order, without the colour of PLY") {
  const Folder folder;
  for (const std::string& format : resultFormats()) {
    CAPTURE(format);
    writeResult(folder / "out", tetrahedron(), sdfAndSeed({0.5, 1, 2.25, 4}, {1, 0, 1, 0}), {.format = format});
    const std::vector<Field> fields = readFields(folder / "out");
    REQUIRE(fields.size() == (format == "npy" ? 1 : 2));
    CHECK(fields[0].name == (format == "npy" ? "values" : "sdf"));
    CHECK(*fields[0].reals() == std::vector<double>{0.5, 1, 2.25, 4});
    if (fields.size() == 2) CHECK(fields[1].name == "seed");
  }
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
    CHECK(holds(errorOfFields("ply", replaced(ply, "255", number)), "line 15: " + std::string(number)));
}

TEST_CASE("every truncation of a file with fields is an error, and so is a byte after its end") {
  const std::vector<Field> fields = everyField(tetrahedron());
  const std::vector<Field> faceFields = everyField(FieldLocation::PerFace, 4, "f_");
  const auto requireStrict = [](const std::string& format, const std::string& whole) {
    CAPTURE(format);
    CHECK(errorOfFields(format, whole) == "no error");
    for (size_t size = 0; size < whole.size(); ++size) {
      CAPTURE(size);
      const bool isWhole = format == "csv" && size > 0 && whole[size - 1] == '\n';  // Has no row count.
      CHECK((errorOfFields(format, whole.substr(0, size)) == "no error") == isWhole);
    }
    CHECK(errorOfFields(format, whole + "x") != "no error");
  };
  requireStrict("ply", written(".ply", tetrahedron(), fields));
  requireStrict("ply", written(".ply", tetrahedron(), fields, {.format = {}, .ascii = true}));
  std::string vtu = written(".vtu", tetrahedron(), fields);
  vtu.pop_back();  // The last line break is optional.
  requireStrict("vtu", vtu);
  requireStrict("npz", written(".npz", tetrahedron(), fields));
  requireStrict("npy", written(".npy", tetrahedron(), fields));
  requireStrict("csv", written(".csv", tetrahedron(), faceFields));
}

TEST_CASE("errors of a VTU name the byte and the reason") {
  const std::string vtu = written(".vtu", tetrahedron(), sdfAndSeed({1, 2, 3, 4}, {1, 0, 1, 0}));
  const auto errorWith = [&](const std::string& part, const std::string& by) {
    return errorOfFields("vtu", replaced(vtu, part, by));
  };
  CHECK(errorWith("NumberOfCells=\"4\"", "NumberOfCells=\"5\"").starts_with("byte "));
  CHECK(holds(errorWith("NumberOfCells=\"4\"", "NumberOfCells=\"5\""), "array 'sdf' has 16 bytes"));
  CHECK(holds(errorWith("NumberOfCells=\"4\"", "NumberOfCells=\"x\""), "is 'x', not a count"));
  CHECK(holds(errorWith("\"LittleEndian\"", "\"BigEndian\""), "only 'LittleEndian' is supported"));
  CHECK(holds(errorWith("header_type=\"UInt32\"", "header_type=\"UInt64\""), "an array"));
  CHECK(holds(errorWith("header_type=", "compressor=\"vtkZLibDataCompressor\" header_type="), "compressor"));
  CHECK(
      holds(errorWith("type=\"Float32\" Name=\"sdf\"", "type=\"Int8\" Name=\"sdf\""), "type 'Int8' are not supported"));
  CHECK(holds(errorWith("Name=\"seed\"", "Name=\"sdf\""), "two fields 'sdf'"));
  CHECK(holds(errorWith("Name=\"seed\"", "Name=\"s d\""), "'s d' is not a name"));
  CHECK(holds(errorWith("Name=\"sdf\" format", "Name=\"sdf\" NumberOfComponents=\"2\" format"), "2 components"));
  CHECK(holds(errorWith("Name=\"seed\" format=\"binary\">BAAA", "Name=\"seed\" format=\"binary\">B!AA"), "'!'"));
  CHECK(holds(errorWith("Name=\"seed\" format=\"binary\">BAAA", "Name=\"seed\" format=\"binary\">BQAA"),
              "header says 5"));
}

TEST_CASE("errors of a CSV name the line and the reason") {
  CHECK(holds(errorOfFields("csv", "index,a\n"), "line 1: the first column is neither 'face' nor 'vertex'"));
  CHECK(holds(errorOfFields("csv", "face,a,a\n"), "two fields 'a'"));
  CHECK(holds(errorOfFields("csv", "face,a b\n"), "'a b' is not a name"));
  CHECK(holds(errorOfFields("csv", "face,a\n0,1\n2,1\n"), "line 3: expected row 1, found row 2"));
  CHECK(holds(errorOfFields("csv", "face,a\n0,1,2\n"), "line 2: the row has more cells"));
  CHECK(holds(errorOfFields("csv", "face,a,b\n0,1\n"), "line 2: the row has fewer cells"));
  CHECK(holds(errorOfFields("csv", "face,a\n0,1x\n"), "line 2: expected a number, found '1x'"));
  CHECK(holds(errorOfFields("csv", "face,a\n0, 1\n"), "found ' 1'"));
  CHECK(holds(errorOfFields("csv", "face,a\n0,1e999\n"), "found '1e999'"));
  CHECK(errorOfFields("csv", "vertex,a\r\n0,-inf\r\n") == "no error");
}

TEST_CASE("errors of an NPY and an NPZ name the byte and the reason") {
  const Field sdf = makeField("sdf", std::vector<double>{1, 2, 3, 4});
  const std::string npy = written(".npy", tetrahedron(), {sdf}), npz = written(".npz", tetrahedron(), {sdf});
  const auto npyError = [&](const std::string& part, const std::string& by) {
    return errorOfFields("npy", replaced(npy, part, by));
  };
  CHECK(holds(npyError("(4,)", "(5,)"), "byte 128: an array of 5 items"));
  CHECK(holds(npyError("(4,), }", "(2, 2), }"), "second dimension"));
  CHECK(holds(npyError("<f4", ">f4"), "type '>f4' are not supported"));
  CHECK(holds(npyError("False", "True "), "in the header"));
  CHECK(holds(npyError("\x93NUMPY\x01", "\x93NUMPY\x02"), "version 1.0"));
  CHECK(errorOfFields("npy", replaced(npy, "<f4', 'fortran_order': False, 'shape': (4,)",
                                      "<f8', 'fortran_order': False, 'shape': (2,)")) == "no error");
  const auto changed = [&](size_t at) {
    std::string bytes = npz;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    return errorOfFields("npz", bytes);
  };
  CHECK(holds(changed(npz.find("sdf.npyface") - 100), "checksum"));  // An entry.
  CHECK(holds(changed(npz.size() - 12), "contradict"));
  CHECK(holds(changed(0), "expected another header"));
  CHECK(holds(errorOfFields("npz", replaced(npz, "sdf.npyface", "sdf.npzface")), "is not a .npy"));
  CHECK(holds(errorOfFields("npz", replaced(npz, "sdf.npyface", "sde.npyface")), "two names"));
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
              "mesh.off: has the format off; fields are read from ply, vtu, npy, npz or csv"));
  CHECK(holds(errorOfReading([&] { return readFields(folder / "missing.csv"); }), "missing.csv: cannot be opened"));
  writeResult(folder / "out.vtu", tetrahedron(), {});
  CHECK(holds(errorOfReading([&] { return readMesh(folder / "out.vtu"); }),
              "has the format vtu; meshes are read from stl, ply, off or obj"));
}
