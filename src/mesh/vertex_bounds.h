#pragma once

#include "core/box3.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// The box of the vertices with finite coordinates, whether faces use them or not.
[[nodiscard]] Box3d boundsOfFiniteVertices(const TriangleMesh& mesh);

/// The box of both.
[[nodiscard]] inline Box3d joined(Box3d a, const Box3d& b) {
  a.add(b);
  return a;
}

}  // namespace asdfvk
