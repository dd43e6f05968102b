// The matrix S: bindings 0 to 2 of every kernel that multiplies by S.
layout(set = 0, binding = 0) readonly buffer Rows { uvec4 rowBlocks[]; };
layout(set = 0, binding = 1) readonly buffer TailColumns { uint tailColumns[]; };
layout(set = 0, binding = 2) readonly buffer TailCouplings { float tailCouplings[]; };

PoissonRow loadRow(uint row) {
  return decodePoissonRow(rowBlocks[row * kPoissonRowBlockCount], rowBlocks[row * kPoissonRowBlockCount + 1u]);
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
