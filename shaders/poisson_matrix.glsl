// Compressed rows of S: bindings 0 to 2 of every kernel that multiplies.
layout(set = 0, binding = 0) readonly buffer RowOffsets { uint rowOffsets[]; };
layout(set = 0, binding = 1) readonly buffer Columns { uint columns[]; };
layout(set = 0, binding = 2) readonly buffer Couplings { float couplings[]; };

// (S v)(row) for the vector `v`, an array's name.
#define COUPLED_SUM(row, v, sum)                                             \
  {                                                                          \
    const uint end = rowOffsets[(row) + 1u];                                 \
    for (uint i = rowOffsets[row]; i < end; ++i) sum += couplings[i] * v[columns[i]]; \
  }
