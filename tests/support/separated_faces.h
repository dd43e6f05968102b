#pragma once

#include "mesh/mesh.h"

namespace asdfvk {

/// The same faces with vertices of their own, as STL files have them.
inline Mesh separated(const Mesh& mesh) {
  Mesh result;
  for (const Face& face : mesh.faces) {
    const auto first = static_cast<uint32_t>(result.vertices.size());
    for (const uint32_t vertex : face) result.vertices.push_back(mesh.vertices[vertex]);
    result.faces.push_back({first, first + 1, first + 2});
  }
  return result;
}

}  // namespace asdfvk
