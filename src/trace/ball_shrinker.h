#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "asdf_vk/run_control.h"
#include "cone/opposing_walls.h"
#include "trace/wall_tree.h"

namespace asdfvk {

/// The thickness of one face.
struct FaceBalls {
  uint32_t face = 0;
  InscribedBall atBarycentre;  ///< The largest ball at the barycentre with no opposing wall inside.
  InscribedBall least;         ///< The least of such balls over all points of the face.
};

/// Shrinks the balls of faces until no opposing wall is inside. The face itself and its coincident copies are no walls,
/// nor is what is not deeper than kMinWallDepth below the face.
class BallShrinker {
 public:
  virtual ~BallShrinker() = default;

  /// Replaces the balls of each face by those of walls that are inside of them; an infinite diameter stands for any
  /// wall. Precondition: no face is degenerate. Returns the number of faces whose balls the reference shrank: iteration
  /// limit of the device reached, or too small for float32. Throws Error{Cancelled} between chunks, Error{Device}.
  virtual uint64_t shrink(std::span<FaceBalls> faces, const RunControl& control) = 0;
};

/// Double precision, on all cores of the CPU. Balls do not depend on the number of threads.
[[nodiscard]] std::unique_ptr<BallShrinker> makeReferenceBallShrinker(const TraceScene& scene,
                                                                      const OpposingWalls& walls);

}  // namespace asdfvk
