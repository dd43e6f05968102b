#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec3.h"
#include "io/formats.h"

/// Access to a glTF 2.0 document, in a .glb file or in a .gltf file with embedded data. All offsets and counts are
/// checked against the size of the file. All functions throw Error{UnreadableInput}; the message begins with `where`,
/// for example "node 3".
namespace asdfvk {

using GltfJson = nlohmann::json;

/// Returns null if the object has no such member. Throws if `object` is not a JSON object.
[[nodiscard]] const GltfJson* gltfMember(const GltfJson& object, const char* key, std::string_view where);
/// Returns a non-negative integer, or `fallback` if there is no such member. Throws if both are missing.
[[nodiscard]] uint64_t gltfWhole(const GltfJson& object, const char* key, std::optional<uint64_t> fallback,
                                 std::string_view where);
/// Returns null if there is no such member.
[[nodiscard]] const GltfJson* gltfArray(const GltfJson& object, const char* key, std::string_view where);
/// Reads numbers.size() finite numbers into `numbers`. Returns false if there is no such member.
[[nodiscard]] bool gltfNumbers(const GltfJson& object, const char* key, std::span<double> numbers,
                               std::string_view where);

class GltfAccessor {
 public:
  [[nodiscard]] uint64_t count() const { return count_; }
  /// Preconditions: i < count(). vectorAt() needs an accessor from GltfFile::vectors(), indexAt() an accessor from
  /// GltfFile::indices().
  [[nodiscard]] Vec3d vectorAt(uint64_t i) const;
  [[nodiscard]] uint32_t indexAt(uint64_t i) const;

 private:
  friend class GltfFile;
  /// Elements of a buffer. stride: distance of two elements in bytes.
  struct Elements {
    const char* data = nullptr;  ///< Null: all elements are 0.
    uint64_t stride = 0;
    uint32_t componentType = 0;
  };
  [[nodiscard]] static uint32_t wholeAt(const Elements& elements, uint64_t i);
  [[nodiscard]] const char* elementAt(uint64_t i) const;

  uint64_t count_ = 0;
  Elements base_, sparseIndices_, sparseValues_;
  uint64_t sparseCount_ = 0;
  bool isNormalized_ = false;
};

class GltfFile {
 public:
  /// `source` must outlive this object.
  explicit GltfFile(const MeshSource& source);

  [[nodiscard]] const GltfJson& document() const { return document_; }
  [[nodiscard]] uint64_t countOf(const char* array) const;
  /// Returns an item of an array of the document, for example of "nodes".
  [[nodiscard]] const GltfJson& item(const char* array, uint64_t index, std::string_view where) const;

  /// Opens the accessor of the given index for vectors of three numbers, or for indices.
  [[nodiscard]] GltfAccessor vectors(uint64_t accessor) const;
  [[nodiscard]] GltfAccessor indices(uint64_t accessor) const;

 private:
  void readBinary(std::span<const char> bytes);
  void parseDocument(std::span<const char> text);
  void requireKnownExtensions() const;
  void readBuffers();
  [[nodiscard]] std::span<const char> viewOf(uint64_t index, uint64_t& stride, std::string_view where) const;
  [[nodiscard]] GltfAccessor::Elements elementsOf(const GltfJson& holder, uint64_t count, uint32_t componentType,
                                                  uint32_t componentCount, bool hasStride,
                                                  std::string_view where) const;
  [[nodiscard]] GltfAccessor open(uint64_t accessor, const char* type, uint32_t componentCount, bool isIndex) const;

  const MeshSource& source_;
  GltfJson document_;
  std::span<const char> binary_;  ///< The BIN chunk; empty if the file has none.
  bool hasBinary_ = false;
  std::vector<std::vector<char>> decoded_;  ///< The bytes of data URIs.
  std::vector<std::span<const char>> buffers_;
};

}  // namespace asdfvk
