#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace asdfvk::bench {

/// From entries per input face (#I) to entries per triangle (#F).
template <typename T>
[[nodiscard]] std::vector<T> onTriangles(const Mesh& mesh, const std::vector<T>& ofInputFaces) {
  if (mesh.polygons.isEmpty()) return ofInputFaces;
  std::vector<T> result;
  result.reserve(mesh.faces.size());
  for (const uint32_t inputFace : mesh.polygons.inputFaceOf) result.push_back(ofInputFaces[inputFace]);
  return result;
}

}  // namespace asdfvk::bench
