#version 450
// Conjugate gradients, last third of an iteration: beta = new r.r / old r.r, p = r + beta p, and the scalars for the
// next iteration, which does nothing once they say so.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

#include "poisson_lanes.glsl"

layout(set = 0, binding = 0) readonly buffer Residual { float r[]; };
layout(set = 0, binding = 1) buffer Direction { float p[]; };
layout(set = 0, binding = 2) buffer States { CgState states[2]; };
layout(set = 0, binding = 3) readonly buffer Sums { PoissonSums sums; };

void main() {
  CgState state = states[push.stateIndex];
  const uint lane = gl_LocalInvocationID.x;
  const bool isFirst = lane == 0u && gl_WorkGroupID.x == 0u;
  if (state.status != kCgRunning) {
    if (isFirst) states[1u - push.stateIndex] = state;
    return;
  }
  vec2 partial = vec2(0.0);
  for (uint i = lane; i < gl_NumWorkGroups.x; i += kLaneCount)
    partial += vec2(sums.residualDot[i], sums.residualSquared[i]);
  const vec2 norms = workgroupSum(partial);

  const float beta = norms.x / state.residualDot;
  for (uint row = firstRow(); row < push.unknownCount; row += rowStride()) p[row] = r[row] + beta * p[row];
  if (!isFirst) return;
  if (sums.brokenDown != 0u || !(norms.y < kLargest))
    state.status = kCgBrokenDown;
  else if (norms.y <= state.toleranceSquared)
    state.status = kCgConverged;
  state.residualDot = norms.x;
  state.residualSquared = norms.y;
  state.iterationCount += 1u;
  states[1u - push.stateIndex] = state;
}
