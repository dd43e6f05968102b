#version 450
// The opposing wall that determines the thickness of a face, one ball per lane. The host computes the diameter from the
// wall in double.
#extension GL_GOOGLE_include_directive : require
#include "shared/ball_layout.h"
#include "shared/cone_hit.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 3) const uint kIterationLimit = 8000;

layout(set = 0, binding = 5) readonly buffer Starts { BallStart starts[]; };
layout(set = 0, binding = 6) writeonly buffer Walls { uint walls[]; };  // Faces, or the constants of ball_layout.h.
layout(push_constant) uniform Push { BallPush push; };

#include "walk_parts.glsl"

#include "ball_query.glsl"

#include "nearest_hit.glsl"

void main() {
  const uint ball = gl_GlobalInvocationID.x;
  if (ball >= push.ballCount) return;
  const BallStart start = starts[ball];
  uint iterationCount = 0u;
  const Hit hit =
      findNearestHit(makeQuery(start.origin, start.axis, start.excludedFace), start.diameter, iterationCount);
  uint wall = kNoFace;
  if (hit.primitive != kNoPrimitive) wall = loadTriangle(hit.primitive).faceIndex;
  walls[ball] = hit.isComplete ? wall : kUnfinishedBall;
}
