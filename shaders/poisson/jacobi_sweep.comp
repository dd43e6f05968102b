#version 450
// One Jacobi iteration, y' = b + S y. The shader also computes the partial sums of the squares of y' - y, the residual
// of y.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

#include "lanes.glsl"
#include "matrix.glsl"

layout(set = 0, binding = 3) readonly buffer RightHandSide { float b[]; };
layout(set = 0, binding = 4) readonly buffer ResidualWeights { float residualWeights[]; };
layout(set = 0, binding = 5) readonly buffer From { float y[]; };
layout(set = 0, binding = 6) writeonly buffer To { float next[]; };
layout(set = 0, binding = 7) buffer Sums { PoissonSums sums; };

void main() {
  float squared = 0.0;
  for (uint row = firstRow(); row < push.unknownCount; row += rowStride()) {
    float value = b[row];
    ADD_COUPLED(row, y, value)
    const float residualWeight = residualWeights[row];
    const float residual = value - y[row];
    next[row] = residualWeight > 0.0 ? value : 0.0;  // See VulkanMatrix::residualWeights.
    squared += residual * residual * residualWeight;
  }
  const float total = workgroupSum(mat2x3(squared, 0.0, 0.0, 0.0, 0.0, 0.0))[0].x;
  if (gl_LocalInvocationID.x == 0u) sums.residualSquared[gl_WorkGroupID.x] = total;
}
