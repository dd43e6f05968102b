#version 450
// Conjugate gradients, second half of an iteration: the scalars, then x += alpha p, r -= alpha q and p = r + beta p.
// After convergence or breakdown, sets the size of the following dispatches to 0 instead.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

#include "lanes.glsl"

layout(set = 0, binding = 0) readonly buffer Product { float q[]; };
layout(set = 0, binding = 1) buffer Solution { float x[]; };
layout(set = 0, binding = 2) buffer Residual { float r[]; };
layout(set = 0, binding = 3) buffer Direction { float p[]; };
layout(set = 0, binding = 4) readonly buffer Sums { PoissonSums sums; };
layout(set = 0, binding = 5) buffer States { CgState states[2]; };
layout(set = 0, binding = 6) writeonly buffer Size { DispatchSize dispatchSize; };

void main() {
  CgState state = states[push.stateIndex];
  const uint lane = gl_LocalInvocationID.x;
  mat2x3 partial = mat2x3(0.0);
  for (uint i = lane; i < push.workgroupCount; i += kLaneCount)
    partial += mat2x3(sums.directionSquared[i], sums.productDot[i], sums.productSquared[i], sums.residualProduct[i],
                      sums.residualDot[i], sums.residualSquared[i]);
  const mat2x3 total = workgroupSum(partial);
  const CgSums rowSums = CgSums(total[0].x, total[0].y, total[0].z, total[1].x, total[1].y, total[1].z);
  const CgStep next = nextCgStep(rowSums, state.toleranceSquared, kCgFloatRounding);
  if (next.status == kCgRunning)
    for (uint row = firstRow(); row < push.unknownCount; row += rowStride()) {
      const float direction = p[row];
      x[row] += next.alpha * direction;
      const float residual = r[row] - next.alpha * q[row];
      r[row] = residual;
      p[row] = residual + next.beta * direction;
    }
  if (lane != 0u || gl_WorkGroupID.x != 0u) return;
  state.residualSquared = rowSums.residualSquared;
  state.status = next.status;
  if (next.status == kCgRunning)
    state.iterationCount += 1u;
  else
    dispatchSize.x = 0u;
  states[1u - push.stateIndex] = state;
}
