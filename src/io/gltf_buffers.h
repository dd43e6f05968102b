#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats.h"
#include "io/gltf_json.h"

namespace asdfvk {

/// The bytes of a buffer view. stride: set if the view states byteStride, or if it was decoded.
struct GltfView {
  std::span<const char> bytes;
  std::optional<uint64_t> stride;
  bool isDecoded = false;
};

/// The buffers of a glTF document: the BIN chunk, data URIs, and files beside. Each buffer is read when its bytes are
/// first needed. All functions throw Error{UnreadableInput}.
class GltfBuffers {
 public:
  /// binary: the BIN chunk; empty if the file has none. The arguments must outlive this object.
  GltfBuffers(const GltfJson& document, std::optional<std::span<const char>> binary, const MeshSource& source);

  /// Decodes a compressed view. The bytes live as long as this object.
  [[nodiscard]] GltfView view(uint64_t index, std::string_view where);
  /// The number of bytes after the ends of buffers, without padding.
  [[nodiscard]] uint64_t unusedByteCount() const { return unusedByteCount_; }

 private:
  std::span<const char> buffer(uint64_t index);
  std::span<const char> load(uint64_t index, const GltfJson& json, const std::string& where);
  std::span<const char> embedded(std::string_view uri, std::string_view where);
  std::span<const char> fileBeside(std::string_view name, std::string_view where);
  std::span<const char> range(const GltfJson& json, const std::string& where);
  [[nodiscard]] bool hasData(uint64_t index, const GltfJson& json, const std::string& where) const;
  GltfView decoded(uint64_t index, const GltfJson& compression, const std::string& where);

  const GltfJson& document_;
  std::optional<std::span<const char>> binary_;
  const MeshSource& source_;
  bool requiresDecoding_;
  std::vector<std::optional<std::span<const char>>> buffers_;
  std::vector<std::vector<char>> embedded_;             ///< The bytes of data URIs.
  std::map<uint64_t, std::vector<char>> decodedViews_;  ///< By the indices of the views.
  uint64_t decodedByteCount_ = 0;
  uint64_t unusedByteCount_ = 0;
};

}  // namespace asdfvk
