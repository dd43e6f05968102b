#version 450
// Copies each field of the structs in shared/poisson_layout.h to a word of its own.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

layout(local_size_x = 8) in;
layout(set = 0, binding = 0) readonly buffer States { CgState states[2]; };
layout(set = 0, binding = 1) readonly buffer Sums { PoissonSums sums; };
layout(set = 0, binding = 2) writeonly buffer Words { uint words[]; };
layout(set = 0, binding = 3, rgba32ui) uniform readonly uimageBuffer rows;
layout(push_constant) uniform Push { PoissonPush push; };

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  for (uint i = 0u; i < 2u; ++i) {
    words[5u * i] = floatBitsToUint(states[i].residualDot);
    words[5u * i + 1u] = floatBitsToUint(states[i].residualSquared);
    words[5u * i + 2u] = floatBitsToUint(states[i].toleranceSquared);
    words[5u * i + 3u] = states[i].iterationCount;
    words[5u * i + 4u] = states[i].status;
  }
  words[10] = push.unknownCount;
  words[11] = push.stateIndex;
  words[12] = sums.brokenDown;
  words[21u + 3u * kMaxPoissonWorkgroupCount] = floatBitsToUint(push.heldBack);
  const PoissonRow row = decodePoissonRow(imageLoad(rows, 0), imageLoad(rows, 1));
  words[13] = row.column0;
  words[14] = row.column1;
  words[15] = row.column2;
  words[16] = row.tailBegin;
  words[17] = row.tailCount;
  words[18] = floatBitsToUint(row.coupling0);
  words[19] = floatBitsToUint(row.coupling1);
  words[20] = floatBitsToUint(row.coupling2);
  for (uint i = 0u; i < kMaxPoissonWorkgroupCount; ++i) {
    words[21u + i] = floatBitsToUint(sums.productDot[i]);
    words[21u + kMaxPoissonWorkgroupCount + i] = floatBitsToUint(sums.residualDot[i]);
    words[21u + 2u * kMaxPoissonWorkgroupCount + i] = floatBitsToUint(sums.residualSquared[i]);
  }
}
