#version 450
// Adds a scaled correction, times push.scale, to differences.
#extension GL_GOOGLE_include_directive : require
#include "shared/equation_layout.h"
#include "shared/poisson_layout.h"
#define PUSH_STRUCT EquationPush
#include "lanes.glsl"

layout(set = 0, binding = 0) readonly buffer Correction { float y[]; };
layout(set = 0, binding = 1) readonly buffer ResidualWeights { float residualWeights[]; };
layout(set = 0, binding = 2) readonly buffer From { float from[]; };
layout(set = 0, binding = 3) writeonly buffer To { float to[]; };

void main() {
  for (uint face = firstRow(); face < push.faceCount; face += rowStride())
    to[face] = from[face] + y[face] * (push.scale * sqrt(residualWeights[face]));
}
