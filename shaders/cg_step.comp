#version 450
// Conjugate gradients, second third of an iteration: alpha = r.r / p.q, x += alpha p, r -= alpha q, and the partial
// sums of the new residual's two norms.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

#include "poisson_lanes.glsl"

layout(set = 0, binding = 0) readonly buffer Direction { float p[]; };
layout(set = 0, binding = 1) readonly buffer Product { float q[]; };
layout(set = 0, binding = 2) readonly buffer ResidualWeights { float residualWeights[]; };
layout(set = 0, binding = 3) buffer Solution { float x[]; };
layout(set = 0, binding = 4) buffer Residual { float r[]; };
layout(set = 0, binding = 5) readonly buffer States { CgState states[2]; };
layout(set = 0, binding = 6) buffer Sums { PoissonSums sums; };

void main() {
  const CgState state = states[push.stateIndex];
  if (state.status != kCgRunning) return;
  const uint lane = gl_LocalInvocationID.x;
  float partial = 0.0;
  for (uint i = lane; i < gl_NumWorkGroups.x; i += kLaneCount) partial += sums.productDot[i];
  const float productDot = workgroupSum(vec2(partial, 0.0)).x;
  const bool isSound = productDot > 0.0 && productDot < kLargest;
  const float alpha = isSound ? state.residualDot / productDot : 0.0;

  vec2 norms = vec2(0.0);
  for (uint row = firstRow(); row < push.unknownCount; row += rowStride()) {
    x[row] += alpha * p[row];
    const float residual = r[row] - alpha * q[row];
    r[row] = residual;
    norms += residual * residual * vec2(1.0, residualWeights[row]);
  }
  norms = workgroupSum(norms);
  if (lane != 0u) return;
  sums.residualDot[gl_WorkGroupID.x] = norms.x;
  sums.residualSquared[gl_WorkGroupID.x] = norms.y;
  if (gl_WorkGroupID.x == 0u) sums.brokenDown = isSound ? 0u : 1u;
}
