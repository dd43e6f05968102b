// GLB and OBJ as results, and the colours of PLY: read again, by our readers and by their text.
#include <doctest/doctest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/vec3.h"
#include "io/result_colours.h"
#include "reading.h"
#include "written_file.h"

using namespace asdfvk;
using namespace asdfvk::test;

namespace {

/// A box of six quads.
Mesh boxOfQuads() {
  std::string text;
  for (const char* corner : {"0 0 0", "2 0 0", "2 1 0", "0 1 0", "0 0 3", "2 0 3", "2 1 3", "0 1 3"})
    text += std::string("v ") + corner + "\n";
  return parse("obj", text + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
}

std::vector<Field> partFields() {
  return {makeField("sdf", std::vector<double>{1, 2, 3, 4, kNoValue, 6}),
          makeField("segment", std::vector<uint32_t>{1, 0, 1, 1, 0, 4294967295})};
}

nlohmann::json documentOf(const std::string& glb) {
  uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, sizeof length);
  return nlohmann::json::parse(glb.substr(20, length));
}

float floatAt(const std::string& glb, const nlohmann::json& document, size_t accessor, size_t entry) {
  const auto& json = document["accessors"][accessor];
  const size_t offset = document["bufferViews"][json["bufferView"].get<size_t>()]["byteOffset"].get<size_t>() +
                        json["byteOffset"].get<size_t>();
  uint32_t jsonLength = 0;
  std::memcpy(&jsonLength, glb.data() + 12, sizeof jsonLength);
  float value = 0;
  std::memcpy(&value, glb.data() + 28 + jsonLength + offset + 4 * entry, sizeof value);
  return value;
}

size_t countOf(std::string_view text, std::string_view part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("a GLB has a primitive and a material per part, and reads as the same surface") {
  const Folder folder;
  const std::filesystem::path file = folder / "parts.glb";
  writeResult(file, boxOfQuads(), partFields());
  const std::string bytes = contentOf(file);
  const nlohmann::json json = documentOf(bytes);
  const auto& primitives = json["meshes"][0]["primitives"];
  REQUIRE(primitives.size() == 3);
  CHECK(json["materials"][0]["name"] == "part 0");
  CHECK(json["materials"][1]["name"] == "part 1");
  CHECK(json["materials"][2]["name"] == "no part");
  // Parts 0, 1 and none have 2, 3 and 1 quads.
  const size_t triangleCounts[] = {4, 6, 2};
  for (size_t i = 0; i < 3; ++i) {
    const size_t position = primitives[i]["attributes"]["POSITION"];
    CHECK(json["accessors"][position]["count"] == 3 * triangleCounts[i]);
    for (const char* name : {"_SDF", "_SEGMENT", "_FACE"}) CHECK(primitives[i]["attributes"].contains(name));
    CHECK(!primitives[i]["attributes"].contains("COLOR_0"));
    CHECK(json["materials"][i]["pbrMetallicRoughness"]["baseColorFactor"] != nlohmann::json{1, 1, 1, 1});
  }
  const auto& first = primitives[0]["attributes"];
  CHECK(floatAt(bytes, json, first["_SDF"], 0) == 2);
  CHECK(floatAt(bytes, json, first["_SDF"], 6) == 0);  // Face 4 has no value.
  CHECK(floatAt(bytes, json, first["_FACE"], 0) == 1);
  CHECK(floatAt(bytes, json, first["_FACE"], 6) == 4);
  CHECK(floatAt(bytes, json, primitives[1]["attributes"]["_SEGMENT"], 0) == 1);
  const Mesh again = readMesh(file);
  CHECK(again.vertices.size() == 8);
  CHECK(again.faces.size() == 12);
  double volume = 0;
  for (const Face& face : again.faces)
    volume += dot(again.vertices[face[0]], cross(again.vertices[face[1]], again.vertices[face[2]])) / 6;
  CHECK(volume == doctest::Approx(6));
}

TEST_CASE("a GLB with parts and the colours of another field has them in COLOR_0, and white materials") {
  const Folder folder;
  const std::filesystem::path file = folder / "parts.glb";
  writeResult(file, boxOfQuads(), partFields(), {.colourOf = "sdf"});
  const nlohmann::json json = documentOf(contentOf(file));
  CHECK(json["meshes"][0]["primitives"].size() == 3);
  CHECK(json["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
  CHECK(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] == nlohmann::json{1, 1, 1, 1});
}

TEST_CASE("a GLB without parts has the colours of the field in COLOR_0") {
  const Folder folder;
  const std::filesystem::path file = folder / "plain.glb";
  Mesh mesh = parse("off", "OFF 4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  for (Vec3d& p : mesh.vertices) p = p + Vec3d{1e8 + 0.1, 0, 0};  // Beyond float32.
  mesh.unit = "mm";
  writeResult(file, mesh, std::vector{makeField("sdf", std::vector<double>{1, 5})});
  const std::string bytes = contentOf(file);
  const nlohmann::json json = documentOf(bytes);
  const auto& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  CHECK(attributes.size() == 3);
  CHECK(json["accessors"][attributes["COLOR_0"].get<size_t>()]["componentType"] == 5123);
  CHECK(json["nodes"][0]["scale"][0] == 0.001);
  const Mesh again = readMesh(file);
  CHECK(again.unit == "m");
  CHECK(again.vertices[2].x == doctest::Approx((1e8 + 1.1) / 1000).epsilon(1e-15));
}

TEST_CASE("an OBJ keeps the faces, and has a material per part in a second file") {
  const Folder folder;
  const std::filesystem::path file = folder / "parts.obj";
  const std::filesystem::path materials = file.string() + ".mtl";
  writeResult(file, boxOfQuads(), partFields());
  const std::string text = contentOf(file), mtl = contentOf(materials);
  CHECK(holds(text, "mtllib " + materials.filename().string() + "\n"));
  CHECK(countOf(text, "usemtl ") == 5);
  CHECK(holds(text, "usemtl part_1\nf 1 4 3 2\nusemtl part_0\nf 5 6 7 8\nusemtl part_1\n"));
  CHECK(holds(text, "usemtl no_part\nf 4 1 5 8\n"));
  CHECK(countOf(mtl, "newmtl ") == 3);
  CHECK(holds(mtl, "newmtl part_0\nKd 0.3059 0.4745 0.6549\n"));
  const Mesh again = readMesh(file);
  CHECK(again.vertices == boxOfQuads().vertices);
  CHECK(again.polygons.corners == boxOfQuads().polygons.corners);
}

TEST_CASE("an OBJ without parts has no second file, and colours of the vertices") {
  const Folder folder;
  const std::filesystem::path file = folder / "plain.obj";
  writeResult(file, boxOfQuads(), std::vector{makeField("sdf", std::vector<double>{1, 2, 3, 4, 5, 6})});
  CHECK_FALSE(std::filesystem::exists(file.string() + ".mtl"));
  const std::string text = contentOf(file);
  CHECK_FALSE(holds(text, "mtllib"));
  CHECK(countOf(text, "\nv ") == 8);
  // Faces 0, 2 and 5 meet at the first vertex: the mean of 1, 3 and 6. The least mean is that of the second one.
  CHECK(holds(text, "\nv 2 0 0 0.2667 0.0039 0.3294\n"));
}

TEST_CASE("the colours of a PLY show the parts, or the chosen field, and on request the vertices") {
  const Folder folder;
  const std::filesystem::path file = folder / "colours.ply";
  WriteOptions options{.ascii = true};
  writeResult(file, boxOfQuads(), partFields(), options);
  CHECK(holds(contentOf(file), "4 0 3 2 1 1 242 142 43 255 1\n"));  // Part 1.
  CHECK_FALSE(holds(contentOf(file), "property double z\nproperty uchar red"));
  options.colourOf = "sdf";
  options.coloursVertices = true;
  writeResult(file, boxOfQuads(), partFields(), options);
  CHECK(holds(contentOf(file), "4 0 3 2 1 1 68 1 84 255 1\n"));  // The least value.
  CHECK(holds(contentOf(file), "property float z\nproperty uchar red\n"));
  options.colourOf = "seed";
  CHECK_THROWS_WITH_AS(writeResult(file, boxOfQuads(), partFields(), options),
                       doctest::Contains("the field seed, because it is not written"), Error);
}
