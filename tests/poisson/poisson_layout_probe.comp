#version 450
// Copies each field of the structs in shared/poisson_layout.h to a word of its own.
#extension GL_GOOGLE_include_directive : require
#include "shared/poisson_layout.h"

layout(local_size_x = 8) in;
layout(set = 0, binding = 0) readonly buffer States { CgState states[2]; };
layout(set = 0, binding = 1) readonly buffer Sums { PoissonSums sums; };
layout(set = 0, binding = 2) writeonly buffer Words { uint words[]; };
layout(set = 0, binding = 3) readonly buffer Rows { uvec4 rows[]; };
layout(set = 0, binding = 4) readonly buffer Size { DispatchSize dispatchSize; };
layout(push_constant) uniform Push { PoissonPush push; };

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  for (uint i = 0u; i < 2u; ++i) {
    words[4u * i] = floatBitsToUint(states[i].residualSquared);
    words[4u * i + 1u] = floatBitsToUint(states[i].toleranceSquared);
    words[4u * i + 2u] = states[i].iterationCount;
    words[4u * i + 3u] = states[i].status;
  }
  words[8] = push.unknownCount;
  words[9] = push.stateIndex;
  words[10] = push.workgroupCount;
  words[11] = dispatchSize.x;
  words[12] = dispatchSize.y;
  words[13] = dispatchSize.z;
  const PoissonRow row = decodePoissonRow(rows[0], rows[1]);
  words[14] = row.column0;
  words[15] = row.column1;
  words[16] = row.column2;
  words[17] = row.tailBegin;
  words[18] = row.tailCount;
  words[19] = floatBitsToUint(row.coupling0);
  words[20] = floatBitsToUint(row.coupling1);
  words[21] = floatBitsToUint(row.coupling2);
  for (uint i = 0u; i < kMaxPoissonWorkgroupCount; ++i) {
    words[22u + i] = floatBitsToUint(sums.directionSquared[i]);
    words[22u + kMaxPoissonWorkgroupCount + i] = floatBitsToUint(sums.productDot[i]);
    words[22u + 2u * kMaxPoissonWorkgroupCount + i] = floatBitsToUint(sums.productSquared[i]);
    words[22u + 3u * kMaxPoissonWorkgroupCount + i] = floatBitsToUint(sums.residualProduct[i]);
    words[22u + 4u * kMaxPoissonWorkgroupCount + i] = floatBitsToUint(sums.residualDot[i]);
    words[22u + 5u * kMaxPoissonWorkgroupCount + i] = floatBitsToUint(sums.residualSquared[i]);
  }
}
