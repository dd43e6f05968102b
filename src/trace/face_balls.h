#pragma once

#include <cstdint>
#include <span>

#include "asdf_vk/run_control.h"
#include "trace/wall_tree.h"

namespace asdfvk {

/// The balls that give the thickness of one face, in normalised coordinates.
struct FaceBalls {
  uint32_t face = 0;
  /// The largest ball that touches the face at its barycentre and contains no opposing wall.
  InscribedBall atBarycentre;
  /// Each point of the face has a largest ball like atBarycentre. `least` is the smallest of these balls.
  InscribedBall least;
};

/// Shrinks the balls of faces until no opposing wall is inside, on all cores. On entry the diameters are upper bounds.
/// Consecutive faces should be neighbours in space, as in WallTree::walls(). Precondition: no face is degenerate.
/// Throws Error{Cancelled} between chunks.
void shrinkFaceBalls(const WallTree& tree, std::span<FaceBalls> faces, const RunControl& control);

}  // namespace asdfvk
