#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "io/corner_welder.h"
#include "io/formats.h"
#include "io/gltf_accessor.h"
#include "io/gltf_file.h"

namespace asdfvk {

enum GltfMode : uint64_t { kGltfPoints = 0, kGltfLines, kGltfLineStrip = 3, kGltfTriangles, kGltfStrip, kGltfFan };

/// A primitive of a mesh, whose accessors are open.
class GltfPrimitive {
 public:
  /// `file` and `json` must outlive this object. where: for example "mesh 0, primitive 1".
  GltfPrimitive(GltfFile& file, const GltfJson& json, std::string where);

  [[nodiscard]] bool hasPositions() const { return positions_.has_value(); }
  [[nodiscard]] uint64_t vertexCount() const { return hasPositions() ? positions_->count() : 0; }
  [[nodiscard]] uint64_t cornerCount() const { return indices_ ? indices_->count() : vertexCount(); }
  [[nodiscard]] bool isEmpty() const { return vertexCount() == 0 || cornerCount() == 0; }
  [[nodiscard]] uint64_t mode() const { return mode_; }
  /// Upper bound of the number of triangles that addTo() adds.
  [[nodiscard]] uint64_t faceCount() const;
  /// Upper bound of the number of vertices of these triangles. Draco data may have more points than the accessor.
  [[nodiscard]] uint64_t maxVertexCount() const {
    return draco_ != nullptr ? 3 * faceCount() : std::min(vertexCount(), 3 * faceCount());
  }

  /// Adds the triangles. Returns the number of triangles that the accessors have and the Draco data lacks.
  uint64_t addTo(std::vector<Face>& faces, CornerWelder& welder, const MeshSource& source) const;

 private:
  uint64_t addDecoded(std::vector<Face>& faces, CornerWelder& welder, const MeshSource& source) const;
  [[nodiscard]] uint64_t vertexAt(uint64_t corner) const;

  GltfFile& file_;
  std::string where_;
  uint64_t mode_ = kGltfTriangles;
  std::optional<GltfAccessor> positions_, indices_;
  const GltfJson* draco_ = nullptr;  ///< The extension; null without Draco.
  uint64_t dracoView_ = 0;           ///< Index of the buffer view with the Draco data.
};

}  // namespace asdfvk
