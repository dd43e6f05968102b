#pragma once

#include <cstdint>
#include <span>

#include "asdf_vk/run_control.h"
#include "trace/wall_tree.h"

namespace asdfvk {

/// The balls that give the thickness of one face, in normalised coordinates.
struct FaceBalls {
  uint32_t face = 0;
  InscribedBall atBarycentre;  ///< The largest ball at the barycentre with no opposing wall inside.
  InscribedBall least;         ///< The least of such balls over all points of the face.
};

/// Shrinks the balls of faces until no opposing wall is inside, on all cores. On entry the diameters are upper bounds.
/// Consecutive faces should be neighbours in space, as in WallTree::walls(). Precondition: no face is degenerate.
/// Throws Error{Cancelled} between chunks.
void shrinkFaceBalls(const WallTree& tree, std::span<FaceBalls> faces, const RunControl& control);

}  // namespace asdfvk
