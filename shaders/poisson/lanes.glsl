// Distribution of rows to lanes and sums over a workgroup, for the Poisson kernels. Include this file first.
// PUSH_STRUCT: type of the push constants, by default PoissonPush.
#include "shared/specialization_ids.h"
#ifndef PUSH_STRUCT
#define PUSH_STRUCT PoissonPush
#endif
layout(local_size_x_id = kLocalSizeXId) in;                     // Equal to kLaneCount.
layout(constant_id = kLaneCountId) const uint kLaneCount = 64;  // A power of two and a multiple of 8.

layout(push_constant) uniform Push { PUSH_STRUCT push; };

shared mat2x3 laneSums[kLaneCount];

uint firstRow() { return gl_WorkGroupID.x * kLaneCount + gl_LocalInvocationID.x; }
uint rowStride() { return push.workgroupCount * kLaneCount; }

// The sum over the lanes of the workgroup, returned to each lane. The order of the sum is fixed, so that the bits are
// the same in every run on a device.
mat2x3 workgroupSum(mat2x3 value) {
  const uint lane = gl_LocalInvocationID.x;
  barrier();  // Waits until all lanes have read the previous sum.
  laneSums[lane] = value;
  barrier();
  for (uint count = kLaneCount / 2u; count > 0u; count /= 2u) {
    if (lane < count) laneSums[lane] += laneSums[lane + count];
    barrier();
  }
  return laneSums[0];
}
