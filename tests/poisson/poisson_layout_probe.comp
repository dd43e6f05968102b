#version 450
// Copies each field of the structs in shared/poisson_layout.h to a word of its own.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

layout(local_size_x = 8) in;
layout(set = 0, binding = 0) readonly buffer States { CgState states[2]; };
layout(set = 0, binding = 1) readonly buffer Sums { PoissonSums sums; };
layout(set = 0, binding = 2) writeonly buffer Words { uint words[]; };
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
  for (uint i = 0u; i < kMaxPoissonWorkgroupCount; ++i) {
    words[13u + i] = floatBitsToUint(sums.productDot[i]);
    words[13u + kMaxPoissonWorkgroupCount + i] = floatBitsToUint(sums.residualDot[i]);
    words[13u + 2u * kMaxPoissonWorkgroupCount + i] = floatBitsToUint(sums.residualSquared[i]);
  }
}
