#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "generate/shapes.h"
#include "page/decoded_page.h"
#include "support/shapes.h"

namespace asdfvk {
namespace {

using FieldList = std::vector<std::reference_wrapper<const Field>>;

test::DecodedMesh throughPage(const Mesh& mesh, const std::vector<Field>& fields = {}) {
  Page page("test");
  page.add(mesh, FieldList(fields.begin(), fields.end()), {.name = "mesh"});
  return test::decodePage(test::htmlOf(page)).meshes.at(0);
}

/// Every face of the mesh once, with its corners in their order at their places, and with vertices shared as they are
/// in the mesh.
void checkSameMesh(const Mesh& mesh, const test::DecodedMesh& decoded) {
  REQUIRE_EQ(decoded.faces.size(), mesh.faces.size());
  std::vector<uint32_t> ids = decoded.faceIds;
  std::sort(ids.begin(), ids.end());
  for (uint32_t i = 0; i < ids.size(); ++i)
    REQUIRE_EQ(ids[i], mesh.polygons.isEmpty() ? i : mesh.polygons.inputFaceOf[i]);
  if (!mesh.polygons.isEmpty()) return;  // A number does not name a triangle.
  std::map<uint32_t, uint32_t> vertexOf, placeOf;
  for (size_t i = 0; i < decoded.faces.size(); ++i) {
    const Face& expected = mesh.faces[decoded.faceIds[i]];
    const Face& found = decoded.faces[i];
    if (!TriangleMesh(mesh).hasFiniteCorners(decoded.faceIds[i])) {
      CHECK((found[0] == found[1] && found[0] == found[2]));
      continue;
    }
    for (size_t k = 0; k < 3; ++k) {
      REQUIRE_EQ(vertexOf.try_emplace(found[k], expected[k]).first->second, expected[k]);
      REQUIRE_EQ(placeOf.try_emplace(expected[k], found[k]).first->second, found[k]);
      const Vec3d difference = decoded.positions[found[k]] - mesh.vertices[expected[k]];
      for (size_t axis = 0; axis < 3; ++axis)
        REQUIRE_LE(std::abs(difference[axis]), 0.51 * decoded.description["step"].get<double>());
    }
  }
}

TEST_CASE("every face returns from a page with its number, winding and corners") {
  for (const Mesh& mesh :
       {shapes::tetrahedron(), shapes::cube(), shapes::sphere(4), shapes::torus(2, 0.7, 40, 23),
        shapes::openBox({1, 2, 3}, 5), shapes::grid(9), shapes::book(7), shapes::fan(12, true), shapes::fan(12, false),
        shapes::boxesWithSharedEdge(), shapes::soup(50, 3),
        shapes::joined(shapes::cube(), shapes::sphere(2), {5, 0, 0}), shapes::inverted(shapes::cube()),
        shapes::joined(shapes::cube(), shapes::inverted(shapes::cube()))})
    checkSameMesh(mesh, throughPage(mesh));
}

TEST_CASE("any triangles return: repeated vertices, duplicates, edges of many faces") {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const uint32_t vertexCount = 3 + static_cast<uint32_t>(seed % 20);
    const Mesh mesh = shapes::randomFaces(vertexCount, 1 + static_cast<uint32_t>(seed) * 3, seed);
    INFO("seed ", seed);
    checkSameMesh(mesh, throughPage(mesh));
  }
}

TEST_CASE("a shuffled mesh returns") {
  Mesh mesh = shapes::torus(2, 0.7, 30, 17);
  std::mt19937 random(5);
  for (size_t i = mesh.faces.size() - 1; i > 0; --i) std::swap(mesh.faces[i], mesh.faces[random() % (i + 1)]);
  checkSameMesh(mesh, throughPage(mesh));
}

TEST_CASE("one face, and faces without finite corners") {
  Mesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {9, 9, 9}};
  one.faces = {{0, 1, 2}};
  const test::DecodedMesh decoded = throughPage(one);
  checkSameMesh(one, decoded);
  CHECK_EQ(decoded.positions.size(), 3);  // The fourth vertex belongs to no face.
  CHECK_EQ(decoded.description["boxMax"][1].get<double>(), 2);

  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Mesh broken = shapes::sphere(2);
  broken.vertices[4] = {nan, 0, 0};
  broken.vertices[9].z = inf;
  checkSameMesh(broken, throughPage(broken));
  for (Vec3d& vertex : broken.vertices) vertex.x = nan;
  checkSameMesh(broken, throughPage(broken));
  for (Vec3d& vertex : broken.vertices) vertex = {1e300, -1e300, 5};  // A box without a side.
  CHECK_EQ(throughPage(broken).faces.size(), broken.faces.size());
}

TEST_CASE("a mesh far from the origin, small or as wide as double") {
  const Mesh mesh = shapes::sphere(3);
  for (const double scale : {1e-20, 1.0, 1e150})
    for (const double shift : {0.0, 1e3 * scale}) {
      const Mesh moved = shapes::scaledAndShifted(mesh, scale, {shift, -shift, shift});
      checkSameMesh(moved, throughPage(moved));
    }
}

Field numbers(std::vector<double> values) {
  return {.name = "number", .label = "a number", .values = std::move(values)};
}

void checkNumbers(const Mesh& mesh, const std::vector<double>& values) {
  const test::DecodedMesh decoded = throughPage(mesh, {numbers(values)});
  const std::vector<double>& returned = decoded.fields.at("number");
  REQUIRE_EQ(returned.size(), values.size());
  constexpr double kRelativeError = 1.0 / 32768, kLeast = 1.2e-38;  // The least float32 with all its digits.
  for (size_t i = 0; i < returned.size(); ++i) {
    const double value = values[decoded.faceIds[i]], error = std::abs(returned[i] - value);
    REQUIRE_EQ(std::isnan(returned[i]), std::isnan(value));
    if (!std::isnan(value)) REQUIRE_LE(error, kRelativeError * std::max(std::abs(value), kLeast));
    if (value == 0) REQUIRE_EQ(returned[i], 0);
  }
}

TEST_CASE("values return with 15 significant bits over a wide range, with zeros and without values") {
  const Mesh mesh = shapes::torus(2, 0.7, 40, 23);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-12, 9);
  std::vector<double> values(mesh.faces.size());
  for (double& value : values) value = std::pow(10.0, exponent(random));
  checkNumbers(mesh, values);
  for (size_t i = 0; i < values.size(); ++i) {
    if (i % 7 == 0) values[i] = kNoValue;
    if (i % 5 == 0) values[i] = 0;
    if (i % 3 == 0) values[i] = -values[i];
  }
  checkNumbers(mesh, values);
  values.assign(values.size(), 1e-44);
  values[3] = std::numeric_limits<float>::max();
  checkNumbers(mesh, values);
}

TEST_CASE("no value at all, only zeros, infinity") {
  const Mesh mesh = shapes::cube();
  checkNumbers(mesh, std::vector<double>(12, kNoValue));
  checkNumbers(mesh, std::vector<double>(12, 0.0));
  const test::DecodedMesh infinite =
      throughPage(mesh, {numbers(std::vector<double>(12, std::numeric_limits<double>::infinity()))});
  for (const double value : infinite.fields.at("number")) CHECK(std::isnan(value));
}

TEST_CASE("labels and flags return") {
  const Mesh mesh = shapes::torus(2, 0.7, 20, 13);
  Field label{.name = "label", .values = std::vector<uint32_t>(mesh.faces.size())};
  Field flag{.name = "flag", .values = std::vector<uint8_t>(mesh.faces.size())};
  auto& labels = std::get<std::vector<uint32_t>>(label.values);
  auto& flags = std::get<std::vector<uint8_t>>(flag.values);
  std::mt19937 random(3);
  for (size_t i = 0; i < labels.size(); ++i) {
    labels[i] = random() % 9 == 0 ? 0xffffffff : random() % 4 == 0 ? 0xfffffffe - random() % 3 : random() % 5;
    flags[i] = random() % 10 == 0;
  }
  const test::DecodedMesh decoded = throughPage(mesh, {label, flag});
  for (size_t i = 0; i < labels.size(); ++i) {
    const uint32_t expected = labels[decoded.faceIds[i]];
    const double returned = decoded.fields.at("label")[i];
    CHECK((expected == 0xffffffff ? std::isnan(returned) : returned == expected));
    CHECK_EQ(decoded.fields.at("flag")[i], flags[decoded.faceIds[i]]);
  }
  CHECK_EQ(decoded.description["fields"][0]["kind"], "label");
  CHECK_EQ(decoded.description["fields"][1]["kind"], "flag");
}

TEST_CASE("a field of a mesh of polygons has the value of the polygon at each of its triangles") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  mesh.polygons = {{0, 4, 8}, {0, 1, 2, 3, 1, 4, 5, 2}, {0, 0, 1, 1}};
  const test::DecodedMesh decoded = throughPage(mesh, {numbers({1.5, 2.5})});
  checkSameMesh(mesh, decoded);
  CHECK_EQ(decoded.description["inputFaceCount"], 2);
  for (size_t i = 0; i < 4; ++i) CHECK_EQ(decoded.fields.at("number")[i], decoded.faceIds[i] == 0 ? 1.5 : 2.5);
}

TEST_CASE("the same mesh twice is stored once") {
  const Mesh mesh = shapes::sphere(4);
  const Field first = numbers(std::vector<double>(mesh.faces.size(), 1.0)),
              second = numbers(std::vector<double>(mesh.faces.size(), 2.0));
  Page page("test");
  page.add(mesh, FieldList{first}, {.name = "a"});
  page.add(mesh, FieldList{second}, {.name = "b"});
  const test::DecodedPage decoded = test::decodePage(test::htmlOf(page));
  REQUIRE_EQ(decoded.meshes.size(), 2);
  CHECK_EQ(decoded.meshes[0].description["arrays"], decoded.meshes[1].description["arrays"]);
  CHECK(decoded.meshes[0].faceIds == decoded.meshes[1].faceIds);  // So that values can be compared face by face.
  CHECK_EQ(decoded.meshes[1].fields.at("number")[5], 2.0);
}

TEST_CASE("a smooth mesh takes few bytes") {
  const Mesh mesh = generateShape("animal", 20000).mesh;
  const test::DecodedMesh decoded = throughPage(mesh);
  CHECK_EQ(decoded.faces.size(), mesh.faces.size());
  Page page("test");
  page.add(mesh, {}, {});
  Page none("test");
  const double bytes = static_cast<double>(test::htmlOf(page).size() - test::htmlOf(none).size());
  CHECK_LT(bytes / mesh.faceCount(), 6);
}

}  // namespace
}  // namespace asdfvk
