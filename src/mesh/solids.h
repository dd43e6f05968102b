#pragma once

#include <cstdint>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

inline constexpr uint32_t kNoBody = 0xffffffff;

/// Components that bound one body: the outer surface and its cavities. A solid has the index of its outer component.
struct Solids {
  std::vector<uint32_t> solidOf;  ///< #F
  std::vector<uint8_t> isClosed;  ///< Per component: it is an outer surface, closed, wound consistently and outwards.
  std::vector<uint8_t> isMisoriented;  ///< Per component: closed, but wound inconsistently, or to the wrong side.
  /// #F: the solid, if that is certain: it isClosed, and no other one may contain the cavity that the face is of. Else
  /// kNoBody.
  std::vector<uint32_t> bodyOf;
};

/// Whether faces may bound the same body. Parts that touch, or are sunk into each other, are not walls of each other.
[[nodiscard]] inline bool mayBeOfOneBody(uint32_t body, uint32_t other) {
  return body == other || body == kNoBody || other == kNoBody;
}

/// A cavity belongs to the smallest closed component, by its box, whose box contains its own.
[[nodiscard]] Solids findSolids(const TriangleMesh& mesh, const Components& components);

}  // namespace asdfvk
