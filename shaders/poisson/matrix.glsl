// The matrix S: bindings 0 to 2 and 8 of every kernel that multiplies by it. Either the image or the buffer holds the
// rows, as in bvh_fetch.glsl.
layout(constant_id = 1) const bool kFetchesTexels = true;

layout(set = 0, binding = 0, rgba32ui) uniform readonly uimageBuffer rowTexels;
layout(set = 0, binding = 8) readonly buffer Rows { uvec4 rowBlocks[]; };
layout(set = 0, binding = 1) readonly buffer TailColumns { uint tailColumns[]; };
layout(set = 0, binding = 2) readonly buffer TailCouplings { float tailCouplings[]; };

PoissonRow loadRow(uint row) {
  const uint block = row * kPoissonRowTexelCount;
  if (kFetchesTexels) return decodePoissonRow(imageLoad(rowTexels, int(block)), imageLoad(rowTexels, int(block) + 1));
  return decodePoissonRow(rowBlocks[block], rowBlocks[block + 1u]);
}

// sum += (S v)(row). v: the name of an array.
#define ADD_COUPLED(row, v, sum)                                                                    \
  {                                                                                                 \
    const PoissonRow entries = loadRow(row);                                                        \
    sum += entries.coupling0 * v[entries.column0] + entries.coupling1 * v[entries.column1] +        \
           entries.coupling2 * v[entries.column2];                                                  \
    const uint tailEnd = entries.tailBegin + entries.tailCount;                                     \
    for (uint i = entries.tailBegin; i < tailEnd; ++i) sum += tailCouplings[i] * v[tailColumns[i]]; \
  }
