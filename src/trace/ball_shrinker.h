#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "asdf_vk/run_control.h"
#include "cone/opposing_walls.h"
#include "cone/touching_ball.h"
#include "shared/cone_hit.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// A ball that touches a face from inside, in normalised coordinates.
struct InscribedBall {
  TouchingBall ball;
  uint32_t wall = kNoFace;  ///< The face that determines the diameter; kNoFace for none.
};

/// The thickness of one face.
struct FaceBalls {
  uint32_t face = 0;
  InscribedBall atBarycentre;  ///< The largest ball at the barycentre with no opposing wall inside.
  InscribedBall least;         ///< The least of such balls over all points of the face.
};

/// Shrinks balls until no opposing wall of their faces is inside. The shrinking ball of Ma, Bae and Choi 2012, but in
/// one traversal of the hierarchy instead of a query per step: the balls of one diameter at all points of a face fill a
/// convex set that contains those of smaller balls, so that a wall that was outside once remains outside. The face
/// itself and its coincident copies are no walls, nor is what is not deeper than kMinWallDepth below the face.
class BallShrinker {
 public:
  virtual ~BallShrinker() = default;

  /// Replaces the balls of each face by those of walls that are inside of them; an infinite diameter stands for any
  /// wall. Precondition: no face is degenerate. Returns the number of faces whose balls the reference shrank: iteration
  /// limit of the device reached, or too small for float32. Throws Error{Cancelled} between chunks, Error{Device}.
  virtual uint64_t shrink(std::span<FaceBalls> faces, const RunControl& control) = 0;
};

/// In normalised units: what is nearer to the plane of a face is contact, or rounding of coordinates in float32.
inline constexpr double kMinWallDepth = 0x1p-21;

/// A face in normalised coordinates.
[[nodiscard]] PlaneTriangle triangleOf(const TraceScene& scene, uint32_t face);

/// Double precision, on all cores of the CPU. Balls do not depend on the number of threads.
[[nodiscard]] std::unique_ptr<BallShrinker> makeReferenceBallShrinker(const TraceScene& scene,
                                                                      const OpposingWalls& walls);

}  // namespace asdfvk
