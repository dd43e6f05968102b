#pragma once

#include <unistd.h>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/mesh.h"

namespace asdfvk::test {

/// The bytes of an array.
template <typename T>
std::string bytesOf(const std::vector<T>& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

inline std::string wordOf(size_t value) { return bytesOf(std::vector<uint32_t>{static_cast<uint32_t>(value)}); }

/// A binary glTF file.
inline std::string glbOf(const nlohmann::json& document, std::string binary) {
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const std::string chunks =
      wordOf(text.size()) + "JSON" + text + wordOf(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + wordOf(2) + wordOf(12 + chunks.size()) + chunks;
}

/// A mesh of float positions and triangles.
struct PlainMesh {
  std::vector<float> positions;
  std::vector<uint32_t> indices;

  [[nodiscard]] size_t vertexCount() const { return positions.size() / 3; }
};

/// The curved surface z = x * y / 50 over a grid of side * side cells.
inline PlainMesh curvedGrid(uint32_t side) {
  PlainMesh mesh;
  for (uint32_t y = 0; y <= side; ++y)
    for (uint32_t x = 0; x <= side; ++x)
      for (const float c : {static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y) / 50.0f})
        mesh.positions.push_back(c);
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t a = y * (side + 1) + x, b = a + side + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  return mesh;
}

/// A box of edge lengths 2, 3 and 4.
inline PlainMesh box() {
  PlainMesh mesh;
  for (uint32_t i = 0; i < 8; ++i)
    for (const float c : {2.0f * (i & 1), 3.0f * (i >> 1 & 1), 4.0f * (i >> 2)}) mesh.positions.push_back(c);
  mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

/// The bytes of the positions, then of the indices.
inline std::string binaryOf(const PlainMesh& mesh) { return bytesOf(mesh.positions) + bytesOf(mesh.indices); }

/// A document of one node with the mesh, whose data is binaryOf(mesh) in buffer 0.
inline nlohmann::json documentOf(const PlainMesh& mesh) {
  using nlohmann::json;
  const size_t positionSize = 4 * mesh.positions.size(), indexSize = 4 * mesh.indices.size();
  return {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", json::array({{{"nodes", {0}}}})},
      {"nodes", json::array({{{"mesh", 0}}})},
      {"meshes", json::array({{{"primitives", json::array({{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}})}}})},
      {"accessors",
       json::array({{{"bufferView", 0}, {"componentType", 5126}, {"count", mesh.vertexCount()}, {"type", "VEC3"}},
                    {{"bufferView", 1}, {"componentType", 5125}, {"count", mesh.indices.size()}, {"type", "SCALAR"}}})},
      {"bufferViews", json::array({{{"buffer", 0}, {"byteLength", positionSize}},
                                   {{"buffer", 0}, {"byteOffset", positionSize}, {"byteLength", indexSize}}})},
      {"buffers", json::array({{{"byteLength", positionSize + indexSize}}})}};
}

inline std::string glbOf(const PlainMesh& mesh) { return glbOf(documentOf(mesh), binaryOf(mesh)); }

/// A temporary folder.
class GltfFolder {
 public:
  GltfFolder() : path_(std::filesystem::temp_directory_path() / ("asdfvk-gltf-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~GltfFolder() { std::filesystem::remove_all(path_); }
  GltfFolder(const GltfFolder&) = delete;
  GltfFolder& operator=(const GltfFolder&) = delete;

  [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& contents) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << contents;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace asdfvk::test
