// Distribution of rows over lanes, and sums over lanes, for the Poisson kernels. Include first.
layout(local_size_x_id = 0) in;
layout(constant_id = 0) const uint kLaneCount = 64;  // A power of two and a multiple of 8.

layout(push_constant) uniform Push { PoissonPush push; };

shared mat2x3 laneSums[kLaneCount];

uint firstRow() { return gl_WorkGroupID.x * kLaneCount + gl_LocalInvocationID.x; }
uint rowStride() { return gl_NumWorkGroups.x * kLaneCount; }

// The sum over the lanes of the workgroup, returned in all of them. A tree of fixed shape, so that repeated runs on a
// device give the same bits.
mat2x3 workgroupSum(mat2x3 value) {
  const uint lane = gl_LocalInvocationID.x;
  barrier();  // Every lane has read the previous sum.
  laneSums[lane] = value;
  barrier();
  for (uint count = kLaneCount / 2u; count > 0u; count /= 2u) {
    if (lane < count) laneSums[lane] += laneSums[lane + count];
    barrier();
  }
  return laneSums[0];
}
