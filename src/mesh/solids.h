#pragma once

#include <cstdint>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Components that bound one body: the outer surface and its cavities.
struct Solids {
  std::vector<uint32_t> solidOf;  ///< #F
  /// Per solid: closed, consistently wound, and its outer surface not inverted.
  std::vector<uint8_t> isClosed;
};

/// A cavity belongs to the smallest closed component, by its box, whose box contains its own.
[[nodiscard]] Solids findSolids(const TriangleMesh& mesh, const Components& components);

}  // namespace asdfvk
