#version 450
// Computes the constant terms of an equation, the residual weights (0 for faces that are not unknowns), and the
// differences. Also computes the partial sums of two squared norms: of the right-hand side (as directionSquared) and of
// the residual.
#extension GL_GOOGLE_include_directive : require
#include "shared/equation_layout.h"
#include "shared/poisson_layout.h"
#define PUSH_STRUCT EquationPush
#include "graph.glsl"
#include "lanes.glsl"

layout(set = 0, binding = 0) readonly buffer Starts { EquationStart starts[]; };
layout(set = 0, binding = 4) buffer Sources {
  float sources[];
};  // Input: the further divergence. Output: the constant terms.
layout(set = 0, binding = 5) writeonly buffer ResidualWeights { float residualWeights[]; };
layout(set = 0, binding = 6) writeonly buffer Differences { float differences[]; };
layout(set = 0, binding = 7) buffer Sums { PoissonSums sums; };

bool has(EquationStart start, uint flag) { return (start.flags & flag) != 0u; }

void main() {
  vec2 squared = vec2(0.0);
  for (uint face = firstRow(); face < push.faceCount; face += rowStride()) {
    const EquationStart start = starts[face];
    float diagonal = 0.0, source = sources[face], known = 0.0, rightHandSide = source;
    for (uint arc = arcBegin(face); has(start, kIsUnknown) && arc < arcEnd(face); ++arc) {
      if (neighbours[arc] == face) continue;
      const float weight = weights[arc];
      const EquationStart other = starts[neighbours[arc]];
      const float baseDifference = weight * (other.base - start.base);
      diagonal += weight;
      if (has(start, kIsGuided) && has(other, kIsGuided))
        rightHandSide -= baseDifference;
      else
        source += baseDifference;
      known += weight * other.difference;
      if (!has(other, kIsUnknown)) rightHandSide += weight * (other.base + other.difference);
    }
    const float residualWeight = diagonal > 0.0 ? 1.0 / diagonal : 0.0;
    sources[face] = source;
    residualWeights[face] = residualWeight;
    differences[face] = start.difference;
    const vec2 both = vec2(rightHandSide, source + known) * residualWeight;
    squared += both * both;
  }
  const vec3 total = workgroupSum(mat2x3(squared, 0.0, 0.0, 0.0, 0.0))[0];
  if (gl_LocalInvocationID.x != 0u) return;
  sums.directionSquared[gl_WorkGroupID.x] = total.x;
  sums.residualSquared[gl_WorkGroupID.x] = total.y;
}
