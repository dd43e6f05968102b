#version 450
// Conjugate gradients, first half of an iteration: the product q = (I - S) p and the partial sums for the second half.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

#include "lanes.glsl"
#include "matrix.glsl"

layout(set = 0, binding = 3) readonly buffer ResidualWeights { float residualWeights[]; };
layout(set = 0, binding = 4) readonly buffer Residual { float r[]; };
layout(set = 0, binding = 5) readonly buffer Direction { float p[]; };
layout(set = 0, binding = 6) writeonly buffer Product { float q[]; };
layout(set = 0, binding = 7) buffer Sums { PoissonSums sums; };

void main() {
  mat2x3 partial = mat2x3(0.0);
  for (uint row = firstRow(); row < push.unknownCount; row += rowStride()) {
    float coupled = 0.0;
    ADD_COUPLED(row, p, coupled)
    const float direction = p[row];
    const float residualWeight = residualWeights[row];
    const float product = residualWeight > 0.0 ? direction - coupled : 0.0;  // See VulkanMatrix::residualWeights.
    const float residual = r[row];
    q[row] = product;
    partial += mat2x3(vec3(direction, product, product) * vec3(direction, direction, product),
                      residual * vec3(product, residual, residual * residualWeight));
  }
  const mat2x3 total = workgroupSum(partial);
  if (gl_LocalInvocationID.x != 0u) return;
  sums.directionSquared[gl_WorkGroupID.x] = total[0].x;
  sums.productDot[gl_WorkGroupID.x] = total[0].y;
  sums.productSquared[gl_WorkGroupID.x] = total[0].z;
  sums.residualProduct[gl_WorkGroupID.x] = total[1].x;
  sums.residualDot[gl_WorkGroupID.x] = total[1].y;
  sums.residualSquared[gl_WorkGroupID.x] = total[1].z;
}
