// How the Poisson kernels share the rows out and add numbers up. Include first.
layout(local_size_x_id = 0) in;
layout(constant_id = 0) const uint kLaneCount = 64;  // A power of two and a multiple of 8.

layout(push_constant) uniform Push { PoissonPush push; };

shared mat2x3 laneSums[kLaneCount];

uint firstRow() { return gl_WorkGroupID.x * kLaneCount + gl_LocalInvocationID.x; }
uint rowStride() { return gl_NumWorkGroups.x * kLaneCount; }

// The sum over the workgroup's lanes, in all of them: a tree of fixed shape, so that a device repeats itself to the
// bit.
mat2x3 workgroupSum(mat2x3 value) {
  const uint lane = gl_LocalInvocationID.x;
  barrier();  // an earlier sum has been read by every lane
  laneSums[lane] = value;
  barrier();
  for (uint count = kLaneCount / 2u; count > 0u; count /= 2u) {
    if (lane < count) laneSums[lane] += laneSums[lane + count];
    barrier();
  }
  return laneSums[0];
}
