#pragma once

#include <cstdint>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Components that bound one body: the outer surface and its cavities. A solid has the index of its outer component.
struct Solids {
  std::vector<uint32_t> solidOf;  ///< #F
  std::vector<uint8_t> isClosed;  ///< Per component: it is an outer surface, closed, wound consistently and outwards.
  std::vector<uint8_t> isMisoriented;  ///< Per component: closed, but wound inconsistently, or to the wrong side.
};

/// A cavity belongs to the smallest closed component, by its box, whose box contains its own.
[[nodiscard]] Solids findSolids(const TriangleMesh& mesh, const Components& components);

}  // namespace asdfvk
