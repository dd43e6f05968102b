#version 450
// The rows of S for a graph (shared/poisson_layout.h). A row has one entry per arc; the first three are in the row
// itself. A separate array has all couplings. Rows with more than three arcs read their further couplings from this
// array.
#extension GL_GOOGLE_include_directive : require
#include "shared/equation_layout.h"
#include "shared/poisson_layout.h"
#define PUSH_STRUCT EquationPush
#include "graph.glsl"
#include "lanes.glsl"

layout(set = 0, binding = 0) writeonly buffer Rows { uvec4 rowBlocks[]; };
layout(set = 0, binding = 4) readonly buffer InverseRoots { float inverseRoots[]; };
layout(set = 0, binding = 5) writeonly buffer Couplings { float couplings[]; };

// Multiplies the roots first, so that the bits are the same in both directions of an edge.
float couplingOf(uint face, uint arc) {
  const uint neighbour = neighbours[arc];
  precise float roots = inverseRoots[face] * inverseRoots[neighbour];
  precise float coupling = weights[arc] * roots;
  return neighbour == face ? 0.0 : coupling;
}

void main() {
  for (uint face = firstRow(); face < push.faceCount; face += rowStride()) {
    const uint begin = arcBegin(face), end = arcEnd(face), headEnd = min(end, begin + kPoissonRowHeadLength);
    uvec3 columns = uvec3(face);
    vec3 heads = vec3(0.0);
    for (uint arc = begin; arc < headEnd; ++arc) {
      columns[arc - begin] = neighbours[arc];
      heads[arc - begin] = couplingOf(face, arc);
    }
    for (uint arc = headEnd; arc < end; ++arc) couplings[arc] = couplingOf(face, arc);
    rowBlocks[face * kPoissonRowBlockCount] = uvec4(columns, headEnd);
    rowBlocks[face * kPoissonRowBlockCount + 1u] = uvec4(floatBitsToUint(heads), end - headEnd);
  }
}
