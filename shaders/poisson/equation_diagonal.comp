#version 450
// D^-1/2 of the matrix of a graph: 1 / sqrt of the sum of the weights of each face; 1 for a face without neighbours.
#extension GL_GOOGLE_include_directive : require
#include "shared/equation_layout.h"
#include "shared/poisson_layout.h"
#define PUSH_STRUCT EquationPush
#include "graph.glsl"
#include "lanes.glsl"

layout(set = 0, binding = 0) writeonly buffer InverseRoots { float inverseRoots[]; };

void main() {
  for (uint face = firstRow(); face < push.faceCount; face += rowStride()) {
    float diagonal = 0.0;
    for (uint arc = arcBegin(face); arc < arcEnd(face); ++arc)
      if (neighbours[arc] != face) diagonal += weights[arc];
    inverseRoots[face] = diagonal > 0.0 ? inversesqrt(diagonal) : 1.0;
  }
}
