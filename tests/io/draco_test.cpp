#include <doctest/doctest.h>
#include <draco/attributes/geometry_attribute.h>
#include <draco/compression/expert_encode.h>
#include <draco/core/varint_encoding.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/text.h"
#include "gltf_building.h"
#include "reading.h"

namespace asdfvk {
namespace {

using nlohmann::json;

struct DracoStyle {
  int method = draco::MESH_EDGEBREAKER_ENCODING;
  int speed = 5;            ///< 0 to 10: other prediction schemes and symbols.
  bool hasNormals = false;  ///< A normal per corner, which splits vertices.
  bool isShort = false;     ///< Positions as 16-bit integers.
  int bits = 0;             ///< Bits per coordinate; 0: not quantized.
};

std::string encodedDraco(const test::PlainMesh& plain, const DracoStyle& style) {
  draco::Mesh mesh;
  const auto cornerCount = static_cast<uint32_t>(plain.indices.size());
  mesh.SetNumFaces(cornerCount / 3);
  mesh.set_num_points(cornerCount);
  draco::GeometryAttribute positions;
  positions.Init(draco::GeometryAttribute::POSITION, nullptr, 3, style.isShort ? draco::DT_INT16 : draco::DT_FLOAT32,
                 false, style.isShort ? 6 : 12, 0);
  const auto vertexCount = static_cast<uint32_t>(plain.vertexCount());
  const int positionId = mesh.AddAttribute(positions, false, vertexCount);
  draco::GeometryAttribute normals;
  normals.Init(draco::GeometryAttribute::NORMAL, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int normalId = style.hasNormals ? mesh.AddAttribute(normals, false, cornerCount / 3) : -1;
  for (uint32_t i = 0; i < vertexCount; ++i) {
    const float* const from = plain.positions.data() + 3 * i;
    const std::array<int16_t, 3> shorts{static_cast<int16_t>(from[0]), static_cast<int16_t>(from[1]),
                                        static_cast<int16_t>(from[2])};
    mesh.attribute(positionId)
        ->SetAttributeValue(draco::AttributeValueIndex(i),
                            style.isShort ? static_cast<const void*>(shorts.data()) : from);
  }
  for (uint32_t i = 0; i < cornerCount; ++i) {
    mesh.attribute(positionId)->SetPointMapEntry(draco::PointIndex(i), draco::AttributeValueIndex(plain.indices[i]));
    if (style.hasNormals) {
      const std::array<float, 3> normal{0, 0, i / 3 % 2 == 0 ? 1.0f : -1.0f};
      mesh.attribute(normalId)->SetAttributeValue(draco::AttributeValueIndex(i / 3), normal.data());
      mesh.attribute(normalId)->SetPointMapEntry(draco::PointIndex(i), draco::AttributeValueIndex(i / 3));
    }
  }
  for (uint32_t i = 0; i < cornerCount / 3; ++i)
    mesh.SetFace(draco::FaceIndex(i),
                 {draco::PointIndex(3 * i), draco::PointIndex(3 * i + 1), draco::PointIndex(3 * i + 2)});
  mesh.DeduplicatePointIds();
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(style.method);
  encoder.SetSpeedOptions(style.speed, style.speed);
  if (style.bits > 0) encoder.SetAttributeQuantization(positionId, style.bits);
  draco::EncoderBuffer buffer;
  REQUIRE(encoder.EncodeToBuffer(&buffer).ok());
  return {buffer.data(), buffer.size()};
}

/// A document whose primitive is the given Draco data.
json dracoDocument(const test::PlainMesh& mesh, size_t dracoSize) {
  json document = test::documentOf(mesh);
  document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  document["buffers"][0]["byteLength"] = dracoSize;
  document["bufferViews"] = json::array({{{"buffer", 0}, {"byteLength", dracoSize}}});
  for (json& accessor : document["accessors"]) accessor.erase("bufferView");
  document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  return document;
}

std::string dracoFile(const test::PlainMesh& mesh, const std::string& draco) {
  return test::glbOf(dracoDocument(mesh, draco.size()), draco);
}

/// The faces as sorted lists of corners, because Draco changes the order of faces and the first corners.
std::vector<std::array<std::array<double, 3>, 3>> sortedFacesOf(const Mesh& mesh) {
  std::vector<std::array<std::array<double, 3>, 3>> faces;
  for (const Face& face : mesh.faces) {
    std::array<std::array<double, 3>, 3> corners{};
    for (size_t c = 0; c < 3; ++c) {
      const Vec3d& p = mesh.vertices[face[c]];
      corners[c] = {p.x, p.y, p.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    faces.push_back(corners);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

constexpr std::string_view kCompressed = "mesh 0, primitive 0 is compressed by Draco, and its data ";

}  // namespace

TEST_CASE("Draco: the faces are those of the plain file, corner by corner") {
  for (const test::PlainMesh& mesh : {test::box(), test::curvedGrid(30)}) {
    const auto expected = sortedFacesOf(test::parse("glb", test::glbOf(mesh)));
    for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING})
      for (const int speed : {0, 3, 5, 10})
        for (const bool hasNormals : {false, true}) {
          CAPTURE(method);
          CAPTURE(speed);
          CAPTURE(hasNormals);
          const Mesh read = test::parse("glb", dracoFile(mesh, encodedDraco(mesh, {method, speed, hasNormals, false})));
          CHECK(sortedFacesOf(read) == expected);
          CHECK(read.skipped.empty());
          CHECK(read.vertices.size() == mesh.vertexCount());
        }
  }
}

TEST_CASE("Draco: quantized positions differ by less than a step") {
  const test::PlainMesh grid = test::curvedGrid(30);
  for (const int speed : {0, 5, 10}) {
    const std::string draco = encodedDraco(grid, {.speed = speed, .bits = 16});
    const Mesh mesh = test::parse("glb", dracoFile(grid, draco));
    CHECK(mesh.faceCount() == 1800);
    REQUIRE(mesh.vertices.size() == grid.vertexCount());
    for (const Vec3d& p : mesh.vertices) {
      CHECK(std::abs(p.x - std::round(p.x)) < 30.0 / 65535);
      CHECK(std::abs(p.z - p.x * p.y / 50) < 0.001);
    }
  }
}

TEST_CASE("Draco: positions may be integers") {
  const test::PlainMesh box = test::box();
  const std::string draco = encodedDraco(box, {.isShort = true});
  json document = dracoDocument(box, draco.size());
  CHECK(test::errorOf("glb", test::glbOf(document, draco)) ==
        std::string(kCompressed) + "has positions of another type than its accessor");
  document["accessors"][0]["componentType"] = 5122;
  const auto expected = sortedFacesOf(test::parse("glb", test::glbOf(box)));
  CHECK(sortedFacesOf(test::parse("glb", test::glbOf(document, draco))) == expected);
}

TEST_CASE("Draco: plain accessors are preferred if the extension is not required") {
  const test::PlainMesh box = test::box();
  json document = test::documentOf(box);
  document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  CHECK(test::parse("glb", test::glbOf(document, test::binaryOf(box))).faceCount() == 12);
  const std::string noHeader = std::string(kCompressed) + "has no header of Draco";
  json required = document;
  required["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  CHECK(test::errorOf("glb", test::glbOf(required, test::binaryOf(box))) == noHeader);
  for (const size_t accessor : {0, 1}) {
    json incomplete = document;
    incomplete["accessors"][accessor].erase("bufferView");
    CHECK(test::errorOf("glb", test::glbOf(incomplete, test::binaryOf(box))) == noHeader);
  }
}

TEST_CASE("Draco: other numbers of faces than in the accessor are refused or reported") {
  const test::PlainMesh box = test::box();
  const std::string draco = encodedDraco(box, {});
  json document = dracoDocument(box, draco.size());
  document["accessors"][1]["count"] = 33;
  CHECK(test::errorOf("glb", test::glbOf(document, draco)) ==
        std::string(kCompressed) + "has 12 faces; its accessor has 11");
  document["accessors"][1]["count"] = 42;
  const Mesh read = test::parse("glb", test::glbOf(document, draco));
  CHECK(read.faceCount() == 12);
  CHECK(joined(read.skipped, ", ") == "2 triangles that their Draco data lacks");
  document["accessors"][1]["count"] = 3'000'000'000;
  CHECK(test::errorOf("glb", test::glbOf(document, draco)).starts_with("has 1,000,000,000 faces; the limit for"));
  document["accessors"][1]["count"] = 36;
  document["meshes"][0]["primitives"][0]["mode"] = 5;
  CHECK(test::errorOf("glb", test::glbOf(document, draco)) ==
        "mesh 0, primitive 0: mode 5 with Draco; export triangles, or without compression");
  document["meshes"][0]["primitives"][0].erase("mode");
  document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 7;
  CHECK(test::errorOf("glb", test::glbOf(document, draco)) == std::string(kCompressed) + "has no attribute 7");
}

TEST_CASE("Draco: counts beyond the limits are refused before memory is allocated") {
  const test::PlainMesh box = test::box();
  const auto headerOf = [](int method, std::vector<uint64_t> counts) {
    std::string bytes = "DRACO";
    for (const int byte : {2, 2, int{draco::TRIANGULAR_MESH}, method, 0, 0}) bytes += static_cast<char>(byte);
    if (method == draco::MESH_EDGEBREAKER_ENCODING) bytes += '\0';  // The kind of traversal.
    draco::EncoderBuffer buffer;
    for (const uint64_t count : counts) draco::EncodeVarint(static_cast<uint32_t>(count), &buffer);
    return bytes + std::string(buffer.data(), buffer.size()) + std::string(2000, '\0');
  };
  const auto refused = [&](const std::string& draco, uint64_t faceCount, uint64_t maxFaces) {
    json document = dracoDocument(box, draco.size());
    document["accessors"][1]["count"] = 3 * faceCount;
    const std::string bytes = test::glbOf(document, draco);
    try {
      (void)parseMesh(bytes, {.maxFaces = maxFaces});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const int edgebreaker = draco::MESH_EDGEBREAKER_ENCODING, sequential = draco::MESH_SEQUENTIAL_ENCODING;
  const std::string tooMany = std::string(kCompressed) + "has 1,400,000,000 faces; its accessor has 12";
  CHECK(refused(headerOf(sequential, {1'400'000'000, 8}), 12, 0) == tooMany);
  CHECK(refused(headerOf(edgebreaker, {8, 1'400'000'000, 0, 0, 0}), 12, 0) == tooMany);
  // 64 MiB, or 512 bytes per byte of the file, or per face of a limit by the user.
  const std::string tooLarge =
      std::string(kCompressed) + "needs more than 64 MiB to be decoded; export without compression";
  CHECK(refused(headerOf(sequential, {100, 4'000'000'000}), 100, 0) == tooLarge);
  CHECK(refused(headerOf(edgebreaker, {50'000, 100'000, 127, 1000, 10}), 100'000, 0) == tooLarge);
  CHECK(refused(headerOf(edgebreaker, {50'000, 100'000, 127, 1000, 10}), 100'000, 5'000'000) ==
        std::string(kCompressed) + "is damaged");
  // Counts that contradict each other.
  for (const std::vector<uint64_t>& counts :
       {std::vector<uint64_t>{4'000'000'000, 12, 0, 12, 0}, {8, 12, 0, 13, 0}, {8, 12, 0, 10, 4'000'000'000}})
    CHECK(refused(headerOf(edgebreaker, counts), 12, 0) == std::string(kCompressed) + "is damaged");
}

TEST_CASE("Draco: the limit of memory is for all primitives of a file") {
  const test::PlainMesh grid = test::curvedGrid(100);
  const std::string draco = encodedDraco(grid, {.bits = 4});
  json document = dracoDocument(grid, draco.size());
  json& primitives = document["meshes"][0]["primitives"];
  primitives = json(10, primitives[0]);
  CHECK(test::parse("glb", test::glbOf(document, draco)).faceCount() == 200'000);
  primitives = json(80, primitives[0]);
  CHECK(
      test::holds(test::errorOf("glb", test::glbOf(document, draco)), "needs more than 64 MiB to be decoded; export"));
  const std::string bytes = test::glbOf(document, draco);
  CHECK(parseMesh(bytes, {.maxFaces = 2'000'000}).faceCount() == 1'600'000);
  document["accessors"][1]["count"] = 300;  // Each primitive claims few faces.
  CHECK(test::errorOf("glb", test::glbOf(document, draco)) ==
        std::string(kCompressed) + "has 20,000 faces; its accessor has 100");
}

TEST_CASE("Draco: data in a file beside count for the limit of faces, also beside a compressed document") {
  const test::PlainMesh grid = test::curvedGrid(100);
  const std::string draco = encodedDraco(grid, {.bits = 4});
  json document = dracoDocument(grid, draco.size());
  json& primitives = document["meshes"][0]["primitives"];
  primitives = json(10, primitives[0]);
  document["buffers"][0]["uri"] = "mesh.bin";
  const test::GltfFolder folder;
  (void)folder.write("mesh.bin", draco);
  CHECK(readMesh(folder.write("mesh.gltf", document.dump())).faceCount() == 200'000);
  CHECK(readMesh(folder.write("mesh.gltf.gz", test::gzipped(document.dump()))).faceCount() == 200'000);
}

TEST_CASE("Draco: damaged data is refused or read, and never crashes") {
  for (const DracoStyle& style :
       {DracoStyle{}, DracoStyle{.speed = 0, .hasNormals = true, .bits = 11}, DracoStyle{.bits = 11},
        DracoStyle{.method = draco::MESH_SEQUENTIAL_ENCODING, .bits = 11},
        DracoStyle{.method = draco::MESH_SEQUENTIAL_ENCODING}}) {
    const test::PlainMesh grid = test::curvedGrid(3);
    const std::string draco = encodedDraco(grid, style);
    for (size_t size = 0; size < draco.size(); ++size) {
      CAPTURE(size);
      const std::string message = test::errorOf("glb", dracoFile(grid, draco.substr(0, size)));
      CHECK(message.starts_with(kCompressed));
    }
    for (size_t i = 0; i < 8 * draco.size(); ++i) {
      CAPTURE(i);
      std::string flipped = draco;
      flipped[i / 8] = static_cast<char>(flipped[i / 8] ^ 1 << i % 8);
      CHECK(test::errorOf("glb", dracoFile(grid, flipped)) != "an error of another kind");
    }
  }
}

}  // namespace asdfvk
