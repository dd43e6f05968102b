#include <doctest/doctest.h>
#include <meshoptimizer.h>

#include <functional>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "gltf_building.h"
#include "reading.h"

namespace asdfvk {
namespace {

using nlohmann::json;

template <typename T>
std::string encodedVertices(const std::vector<T>& values, size_t count, size_t stride) {
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride));
  return test::bytesOf(bytes);
}

std::string encodedIndices(const std::vector<uint32_t>& indices, size_t vertexCount, bool isSequence) {
  const size_t bound = isSequence ? meshopt_encodeIndexSequenceBound(indices.size(), vertexCount)
                                  : meshopt_encodeIndexBufferBound(indices.size(), vertexCount);
  std::vector<unsigned char> bytes(bound);
  bytes.resize(isSequence ? meshopt_encodeIndexSequence(bytes.data(), bound, indices.data(), indices.size())
                          : meshopt_encodeIndexBuffer(bytes.data(), bound, indices.data(), indices.size()));
  return test::bytesOf(bytes);
}

struct MeshoptFile {
  json document;
  std::string binary;
  [[nodiscard]] std::string bytes() const { return test::glbOf(document, binary); }
};

/// Compresses both views of the document of the mesh. Buffer 1 has their uncompressed bytes, or only claims them.
MeshoptFile meshoptFile(const test::PlainMesh& mesh, const std::string& extension, bool isSequence,
                        const std::string& vertices = {}, const std::string& filter = {}) {
  const size_t vertexCount = mesh.vertexCount(), indexCount = mesh.indices.size();
  const std::string positions = vertices.empty() ? encodedVertices(mesh.positions, vertexCount, 12) : vertices;
  const std::string indices = encodedIndices(mesh.indices, vertexCount, isSequence);
  MeshoptFile file{test::documentOf(mesh), positions + indices};
  file.document["extensionsRequired"] = {extension};
  file.document["buffers"].push_back(file.document["buffers"][0]);
  file.document["buffers"][0]["byteLength"] = file.binary.size();
  file.document["buffers"][1]["extensions"][extension] = {{"fallback", true}};
  json& views = file.document["bufferViews"];
  views[0]["buffer"] = views[1]["buffer"] = 1;
  views[0]["extensions"][extension] = {{"buffer", 0},
                                       {"byteLength", positions.size()},
                                       {"byteStride", 12},
                                       {"mode", "ATTRIBUTES"},
                                       {"count", vertexCount}};
  if (!filter.empty()) views[0]["extensions"][extension]["filter"] = filter;
  views[1]["extensions"][extension] = {{"buffer", 0},
                                       {"byteOffset", positions.size()},
                                       {"byteLength", indices.size()},
                                       {"byteStride", 4},
                                       {"mode", isSequence ? "INDICES" : "TRIANGLES"},
                                       {"count", indexCount}};
  return file;
}

/// The corners of all faces. meshoptimizer may rotate the corners of a face; this begins each with its least corner.
std::vector<Vec3d> cornersOf(const Mesh& mesh) {
  std::vector<Vec3d> corners;
  for (const Face& face : mesh.faces) {
    size_t first = 0;
    const auto isLess = [&](const Vec3d& a, const Vec3d& b) {
      return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    for (size_t c = 1; c < 3; ++c)
      if (isLess(mesh.vertices[face[c]], mesh.vertices[face[first]])) first = c;
    for (size_t c = 0; c < 3; ++c) corners.push_back(mesh.vertices[face[(first + c) % 3]]);
  }
  return corners;
}

}  // namespace

TEST_CASE("meshopt: compressed positions and indices are those of the plain file") {
  for (const test::PlainMesh& mesh : {test::box(), test::curvedGrid(40)}) {
    const std::vector<Vec3d> expected = cornersOf(test::parse("glb", test::glbOf(mesh)));
    for (const char* const extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
      for (const bool isSequence : {false, true}) {
        CAPTURE(extension);
        CAPTURE(isSequence);
        const Mesh read = test::parse("glb", meshoptFile(mesh, extension, isSequence).bytes());
        CHECK(cornersOf(read) == expected);
        CHECK(read.skipped.empty());
      }
  }
}

TEST_CASE("meshopt: the exponential filter restores positions, and the others restore what they store") {
  const test::PlainMesh grid = test::curvedGrid(10);  // Multiples of 1/50: 24 bits suffice to 1e-6.
  std::vector<uint32_t> filtered(grid.positions.size());
  meshopt_encodeFilterExp(filtered.data(), grid.vertexCount(), 12, 24, grid.positions.data());
  const std::string vertices = encodedVertices(filtered, grid.vertexCount(), 12);
  const Mesh plain = test::parse("glb", test::glbOf(grid));
  const Mesh read =
      test::parse("glb", meshoptFile(grid, "EXT_meshopt_compression", true, vertices, "EXPONENTIAL").bytes());
  REQUIRE(read.faces == plain.faces);
  for (size_t i = 0; i < plain.vertices.size(); ++i) CHECK(length(read.vertices[i] - plain.vertices[i]) < 1e-5);

  // Unit vectors and quaternions in 16 bits, read as positions.
  json document = test::documentOf(test::box());
  for (const char* const filter : {"OCTAHEDRAL", "QUATERNION"}) {
    CAPTURE(filter);
    const std::vector<float> vectors{0, 0, 1, 0, 0.6f, 0.8f, 0, 0, 1, 0, 0, 0};
    std::vector<int16_t> stored(vectors.size());
    const bool isOctahedral = std::string(filter) == "OCTAHEDRAL";
    (isOctahedral ? meshopt_encodeFilterOct : meshopt_encodeFilterQuat)(stored.data(), 3, 8, 16, vectors.data());
    const test::PlainMesh triangle{{0, 0, 0, 0, 0, 0, 0, 0, 0}, {0, 1, 2}};
    MeshoptFile file = meshoptFile(triangle, "EXT_meshopt_compression", true, encodedVertices(stored, 3, 8), filter);
    file.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteStride"] = 8;
    file.document["accessors"][0]["componentType"] = 5122;
    file.document["accessors"][0]["normalized"] = true;
    const std::vector<Vec3d> points = test::parse("glb", file.bytes()).vertices;
    REQUIRE(points.size() == 3);
    for (size_t i = 0; i < 3; ++i)
      for (size_t axis = 0; axis < 3; ++axis)
        CHECK(points[i][axis] == doctest::Approx(static_cast<double>(vectors[4 * i + axis])).epsilon(1e-3));
  }
}

TEST_CASE("meshopt: plain bytes are preferred if the extension is not required and the buffer is not a fallback") {
  const test::PlainMesh box = test::box();
  MeshoptFile file = meshoptFile(box, "EXT_meshopt_compression", true);
  file.document.erase("extensionsRequired");
  CHECK(test::parse("glb", file.bytes()).faceCount() == 12);
  file.document["buffers"][1].erase("extensions");
  file.document["buffers"][1]["uri"] = "data:;base64,AAAA";
  CHECK(test::errorOf("glb", file.bytes()) == "buffer 1: byteLength 240; its data has 3 bytes");
}

TEST_CASE("meshopt: impossible layouts are refused") {
  const test::PlainMesh box = test::box();
  const auto refused = [&](size_t view, const char* key, const json& value) {
    MeshoptFile file = meshoptFile(box, "EXT_meshopt_compression", false);
    file.document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][key] = value;
    return test::errorOf("glb", file.bytes());
  };
  CHECK(refused(0, "mode", "VERTICES") == "buffer view 0: its mode 'VERTICES' is unknown");
  CHECK(refused(0, "filter", "COLOR") == "buffer view 0: its filter 'COLOR' is unknown");
  for (const uint64_t stride : {uint64_t{0}, uint64_t{260}, UINT64_MAX})
    CHECK(test::holds(refused(0, "byteStride", stride), "buffer view 0: byteStride "));
  for (const uint64_t stride : {1, 6, 10, 255})
    CHECK(test::holds(refused(0, "byteStride", stride), "its mode or filter does not allow 8 elements of"));
  for (const char* const filter : {"OCTAHEDRAL", "QUATERNION"})
    CHECK(test::holds(refused(0, "filter", filter), "its mode or filter does not allow 8 elements of 12 bytes"));
  CHECK(test::holds(refused(1, "filter", "EXPONENTIAL"), "its mode or filter does not allow"));
  CHECK(test::holds(refused(1, "byteStride", 8), "its mode or filter does not allow"));
  CHECK(test::holds(refused(1, "count", 35), "its mode or filter does not allow"));
  CHECK(refused(1, "byteStride", 2) == "accessor 1: has elements of 4 bytes; its buffer view has 2");
  CHECK(test::holds(refused(0, "byteStride", 16), "is compressed by meshopt, and its data is damaged"));
  CHECK(test::holds(refused(0, "count", 1000), "is compressed by meshopt, and its data is damaged"));
  CHECK(refused(0, "count", 7) == "accessor 0: 8 elements do not fit into the 84 bytes of its buffer view");
  CHECK(test::holds(refused(0, "count", 0), "is compressed by meshopt, and its data is damaged"));
  CHECK(refused(0, "count", UINT64_MAX) ==
        "buffer view 0: the compressed views of this file need more than 64 MiB; export without compression");
  CHECK(test::holds(refused(0, "byteLength", 10000), "buffer view 0: bytes 0 to 0 + 10000 are beyond the"));
}

TEST_CASE("meshopt: damaged data is refused or read, and never crashes") {
  for (const bool isSequence : {false, true}) {
    const MeshoptFile file = meshoptFile(test::curvedGrid(3), "EXT_meshopt_compression", isSequence);
    const size_t half = file.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteLength"];
    for (size_t size = 0; size < file.binary.size(); ++size) {
      MeshoptFile cut = file;
      json& view = cut.document["bufferViews"][size < half ? 0 : 1]["extensions"]["EXT_meshopt_compression"];
      view["byteLength"] = size < half ? size : size - half;
      CAPTURE(size);
      const std::string message = test::errorOf("glb", cut.bytes());
      CHECK(test::holds(message, "is compressed by meshopt, and its data is damaged"));
    }
    for (size_t i = 0; i < 8 * file.binary.size(); ++i) {
      MeshoptFile flipped = file;
      flipped.binary[i / 8] = static_cast<char>(flipped.binary[i / 8] ^ 1 << i % 8);
      CHECK(test::errorOf("glb", flipped.bytes()) != "an error of another kind");
    }
  }
}

}  // namespace asdfvk
