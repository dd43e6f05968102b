// Input and output of the kernel that shrinks balls (shrink_ball.comp); included by C++ and by GLSL.
#ifndef ASDFVK_BALL_LAYOUT_H
#define ASDFVK_BALL_LAYOUT_H

#ifdef __cplusplus
#include <cstddef>

#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
using glsl::vec3;
#endif

// A ball that touches a face at `origin`, 32 bytes. Normalised coordinates.
struct BallStart {
  vec3 origin;
  uint excludedFace;  // The representative of the face, which is no wall.
  vec3 axis;          // Inward unit normal of the face.
  float diameter;
};

struct BallPush {
  uint ballCount;
  float wallCosine;       // OpposingWalls of src/cone/thickness.h.
  uint childNormalStart;  // In nodeBlocks, in blocks of 16 bytes; unused with texels.
};

// A result is a face, kNoFace (of cone_hit.h) where no wall is inside of the ball, or this: the iteration limit stopped
// the ball, and the reference shrinks it.
const uint kUnfinishedBall = 0xfffffffeu;

#ifdef __cplusplus
static_assert(sizeof(BallStart) == 32);
static_assert(offsetof(BallStart, origin) == 0 && offsetof(BallStart, excludedFace) == 12);
static_assert(offsetof(BallStart, axis) == 16 && offsetof(BallStart, diameter) == 28);
static_assert(sizeof(BallPush) == 12 && offsetof(BallPush, wallCosine) == 4);
static_assert(offsetof(BallPush, childNormalStart) == 8);
}  // namespace asdfvk
#endif

#endif
