#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/files.h"

namespace asdfvk {

/// A new folder, removed with the object.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "asdfvk-writers-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) names.push_back(entry.path().filename());
    return names;
  }

 private:
  std::filesystem::path path_;
};

inline std::string contentOf(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void putContent(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

inline Field makeField(const std::string& name, Field::Values values, FieldLocation location = FieldLocation::PerFace,
                       uint32_t componentCount = 1) {
  Field field;
  field.name = name;
  field.location = location;
  field.componentCount = componentCount;
  field.values = std::move(values);
  return field;
}

/// The fields of a computation by default.
inline std::vector<Field> sdfAndSeed(const std::vector<double>& sdf, const std::vector<uint8_t>& seed) {
  return {makeField("sdf", sdf), makeField("seed", seed)};
}

/// The content of a file of that extension that writeResult() wrote.
inline std::string written(const std::string& extension, const MeshView& mesh, const std::vector<Field>& fields,
                           const WriteOptions& options = {}) {
  const Folder folder;
  writeResult(folder / ("out" + extension), mesh, fields, options);
  return contentOf(folder / ("out" + extension));
}

/// Reads successive numbers.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  template <typename T>
  T take() {
    T value{};
    if (bytes_.size() < sizeof(T)) throw std::out_of_range("the file ends too early");
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return value;
  }
  [[nodiscard]] bool isAtEnd() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

/// A tetrahedron with coordinates that float holds exactly.
inline Mesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}, {0, 0, -2}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}, {}};
}

/// A quad, a triangle, a pentagon and a face of two corners, with their triangles.
inline Mesh polygonMesh() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 0}, {0.5, 2, 0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}, {0, 1, 4}, {0, 4, 2}, {0, 2, 5}};
  mesh.polygons.firstCorner = {0, 4, 7, 12, 14};
  mesh.polygons.corners = {0, 1, 2, 3, 1, 4, 2, 0, 1, 4, 2, 5, 3, 5};
  mesh.polygons.inputFaceOf = {0, 0, 1, 2, 2, 2};
  return mesh;
}

}  // namespace asdfvk
