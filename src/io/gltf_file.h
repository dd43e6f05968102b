#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/draco_mesh.h"
#include "io/formats.h"
#include "io/gltf_accessor.h"
#include "io/gltf_buffers.h"
#include "io/gltf_json.h"

namespace asdfvk {

/// Access to a glTF 2.0 document, in a .glb or a .gltf file. All offsets and counts are checked against the size of the
/// data. All functions throw Error{UnreadableInput}; the message begins with the place, for example "accessor 3".
class GltfFile {
 public:
  /// `source` must outlive this object.
  explicit GltfFile(const MeshSource& source);
  GltfFile(const GltfFile&) = delete;
  GltfFile& operator=(const GltfFile&) = delete;

  [[nodiscard]] const GltfJson& document() const { return document_; }
  [[nodiscard]] uint64_t countOf(const char* array) const { return gltfCount(document_, array); }
  /// Returns an item of an array of the document, for example of "nodes".
  [[nodiscard]] const GltfJson& item(const char* array, uint64_t index, std::string_view where) const {
    return gltfItem(document_, array, index, where);
  }

  /// Opens the accessor of the given index for vectors of three numbers, or for indices. An accessor may have no
  /// elements.
  [[nodiscard]] GltfAccessor vectors(uint64_t accessor) { return open(accessor, false); }
  [[nodiscard]] GltfAccessor indices(uint64_t accessor) { return open(accessor, true); }
  [[nodiscard]] bool requiresDraco() const { return requiresDraco_; }
  [[nodiscard]] DracoBudget& dracoBudget() { return dracoBudget_; }
  /// The bytes of a buffer view.
  [[nodiscard]] std::span<const char> bytesOf(uint64_t view, std::string_view where) {
    return buffers_->view(view, where).bytes;
  }

  /// The number of bytes after the end of a GLB file.
  [[nodiscard]] uint64_t trailingByteCount() const { return trailingByteCount_; }
  [[nodiscard]] uint64_t unusedByteCount() const { return buffers_->unusedByteCount(); }

 private:
  std::optional<std::span<const char>> readChunks();
  void requireKnownExtensions() const;
  GltfAccessor open(uint64_t index, bool isIndex);
  GltfAccessor opened(const GltfJson& json, bool isIndex, const std::string& where);
  void openSparse(const GltfJson& sparse, uint32_t componentCount, GltfAccessor& accessor, const std::string& where);
  GltfAccessor::Elements elementsOf(const GltfJson& holder, uint64_t count, uint32_t componentType,
                                    uint32_t componentCount, bool hasStride, std::string_view where);

  const MeshSource& source_;
  GltfJson document_;
  std::optional<GltfBuffers> buffers_;
  std::map<std::pair<uint64_t, bool>, GltfAccessor> opened_;  ///< By index and by whether it has indices.
  uint64_t sparseElementCount_ = 0;
  bool requiresDraco_ = false;
  DracoBudget dracoBudget_;
  uint64_t trailingByteCount_ = 0;
};

}  // namespace asdfvk
