#version 450
// Conjugate gradients, first third of an iteration: q = (I - S) p and the partial sums of p.q.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

#include "poisson_lanes.glsl"
#include "poisson_matrix.glsl"

layout(set = 0, binding = 3) readonly buffer Direction { float p[]; };
layout(set = 0, binding = 4) writeonly buffer Product { float q[]; };
layout(set = 0, binding = 5) readonly buffer States { CgState states[2]; };
layout(set = 0, binding = 6) buffer Sums { PoissonSums sums; };

void main() {
  if (states[push.stateIndex].status != kCgRunning) return;
  float dot = 0.0;
  for (uint row = firstRow(); row < push.unknownCount; row += rowStride()) {
    float coupled = 0.0;
    ADD_COUPLED(row, p, coupled)
    const float direction = p[row];
    const float product = direction - coupled;
    q[row] = product;
    dot += direction * product;
  }
  const float total = workgroupSum(vec2(dot, 0.0)).x;
  if (gl_LocalInvocationID.x == 0u) sums.productDot[gl_WorkGroupID.x] = total;
}
