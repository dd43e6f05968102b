#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

inline constexpr uint32_t kNoBody = 0xffffffff;

/// A solid is the set of components that bound one body: the outer surface and its cavities. The index of a solid is
/// the index of its outer component. A component that bounds no body is a separate solid.
struct Solids {
  std::vector<uint32_t> solidOf;  ///< #F
  /// For each component: whether it is an outer surface, closed and wound consistently outwards.
  std::vector<uint8_t> isClosed;
  /// For each component: the innermost component around it (Nesting::parentOf). Empty if not needed.
  std::vector<uint32_t> parentOf = {};

  /// The solid of the face if this solid is closed, else kNoBody.
  [[nodiscard]] uint32_t bodyOf(uint32_t face) const { return isClosed[solidOf[face]] != 0 ? solidOf[face] : kNoBody; }

  /// Whether faces may bound the same body. Parts that touch or overlap are not walls of each other.
  [[nodiscard]] bool mayBoundOneBody(uint32_t face, uint32_t other) const {
    const uint32_t body = bodyOf(face), otherBody = bodyOf(other);
    return body == otherBody || body == kNoBody || otherBody == kNoBody;
  }
};

/// Solids that meet become one solid, with the lowest of their indices. meeting: pairs of components that meet. A
/// pair with a solid that is not closed has no effect.
void joinSolids(const Components& components, std::span<const std::pair<uint32_t, uint32_t>> meeting, Solids& solids);

/// A cavity belongs to the innermost body around it (findCavities()) if this body is closed and wound outwards.
[[nodiscard]] Solids findSolids(const TriangleMesh& mesh, const Components& components);

}  // namespace asdfvk
