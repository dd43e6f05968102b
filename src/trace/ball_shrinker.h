#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "asdf_vk/run_control.h"
#include "cone/thickness.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// A ball that touches a face at its barycentre from inside, and an opposing wall of the face (cone/thickness.h).
struct InscribedBall {
  uint32_t face = 0;
  uint32_t wall = 0;    ///< The face that determines the diameter.
  double diameter = 0;  ///< In normalised units.
};

/// The diameter of the ball that touches both faces, in normalised units; infinity where it is not below `limit`.
[[nodiscard]] double touchingDiameter(const TraceScene& scene, uint32_t face, uint32_t wall, double limit);

/// Shrinks balls until no opposing wall of their faces is inside. The shrinking ball of Ma, Bae and Choi 2012, but in
/// one traversal of the hierarchy instead of a query per step: all balls of a face touch it at the same point, so that
/// each contains all smaller ones, and a wall that was outside of the ball once remains outside. The face itself and
/// its coincident copies are no walls.
class BallShrinker {
 public:
  virtual ~BallShrinker() = default;

  /// Replaces wall and diameter where a wall is inside of the ball. Precondition: no face is degenerate. Returns the
  /// number of balls that the reference shrank: iteration limit of the device reached, or too small for float32. Throws
  /// Error{Cancelled} between chunks, Error{Device}.
  virtual uint64_t shrink(std::span<InscribedBall> balls, const RunControl& control) = 0;
};

/// Double precision, on all cores of the CPU. Diameters do not depend on the number of threads.
[[nodiscard]] std::unique_ptr<BallShrinker> makeReferenceBallShrinker(const TraceScene& scene,
                                                                      const OpposingWalls& walls);

}  // namespace asdfvk
