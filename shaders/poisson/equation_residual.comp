#version 450
// The residual of the differences, scaled like b in shared/poisson_layout.h, times push.scale. The shader also computes
// the partial sums of the squared weighted norm of the residual.
#extension GL_GOOGLE_include_directive : require
#include "shared/equation_layout.h"
#include "shared/poisson_layout.h"
#define PUSH_STRUCT EquationPush
#include "graph.glsl"
#include "lanes.glsl"

layout(set = 0, binding = 0) readonly buffer Sources { float sources[]; };
layout(set = 0, binding = 4) readonly buffer ResidualWeights { float residualWeights[]; };
layout(set = 0, binding = 5) readonly buffer Differences { float differences[]; };
layout(set = 0, binding = 6) writeonly buffer ScaledResidual { float b[]; };
layout(set = 0, binding = 7) buffer Sums { PoissonSums sums; };

void main() {
  float squared = 0.0;
  for (uint face = firstRow(); face < push.faceCount; face += rowStride()) {
    const float residualWeight = residualWeights[face], difference = differences[face];
    float scaled = 0.0;
    if (residualWeight > 0.0) {
      float residual = sources[face];
      for (uint arc = arcBegin(face); arc < arcEnd(face); ++arc)
        residual += weights[arc] * (differences[neighbours[arc]] - difference);
      scaled = residual * push.scale * sqrt(residualWeight);
    }
    b[face] = scaled;
    squared += scaled * scaled * residualWeight;
  }
  const float total = workgroupSum(mat2x3(squared, 0.0, 0.0, 0.0, 0.0, 0.0))[0].x;
  if (gl_LocalInvocationID.x == 0u) sums.residualSquared[gl_WorkGroupID.x] = total;
}
