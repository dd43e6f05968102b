#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/vec3.h"
#include "io/gltf_accessor.h"

namespace asdfvk {

/// A mesh that was compressed by Draco.
struct DracoMesh {
  std::vector<Face> faces;      ///< Indices of points.
  std::vector<char> positions;  ///< Three numbers of the demanded type per point.
};

/// Memory for decoding, summed over the meshes of a file, because many primitives may have the same data.
struct DracoBudget {
  uint64_t usedByteCount = 0;
  uint64_t maxByteCount = 0;
};

struct DracoRequest {
  uint64_t positionId = 0;     ///< The unique id of the attribute with the positions.
  GltfType type = kGltfFloat;  ///< The type of the positions.
  uint64_t maxFaceCount = 0;
};

/// Throws Error{UnreadableInput} if the bytes are damaged or exceed the limits, and if this build has no libdraco. The
/// limits are checked before memory is allocated. The message begins with `where`.
[[nodiscard]] DracoMesh decodeDraco(std::span<const char> bytes, const DracoRequest& request, DracoBudget& budget,
                                    std::string_view where);

}  // namespace asdfvk
