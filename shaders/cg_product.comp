#version 450
// Conjugate gradients, first half of an iteration: the product (I - S) p and the partial sums of all that the second
// half wants to know.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

#include "poisson_lanes.glsl"
#include "poisson_matrix.glsl"

layout(set = 0, binding = 3) readonly buffer ResidualWeights { float residualWeights[]; };
layout(set = 0, binding = 4) readonly buffer Residual { float r[]; };
layout(set = 0, binding = 5) readonly buffer Direction { float p[]; };
layout(set = 0, binding = 6) writeonly buffer Product { float q[]; };
layout(set = 0, binding = 7) buffer Sums { PoissonSums sums; };

void main() {
  vec4 partial = vec4(0.0);
  for (uint row = firstRow(); row < push.unknownCount; row += rowStride()) {
    float coupled = 0.0;
    ADD_COUPLED(row, p, coupled)
    const float direction = p[row];
    const float product = direction - coupled;
    const float residual = r[row];
    q[row] = product;
    partial += vec4(product, product, residual, residual) *
               vec4(direction, product, residual, residual * residualWeights[row]);
  }
  const vec4 total = workgroupSum(partial);
  if (gl_LocalInvocationID.x != 0u) return;
  sums.productDot[gl_WorkGroupID.x] = total.x;
  sums.productSquared[gl_WorkGroupID.x] = total.y;
  sums.residualDot[gl_WorkGroupID.x] = total.z;
  sums.residualSquared[gl_WorkGroupID.x] = total.w;
}
