// The weighted dual graph: bindings 1 to 3 of the equation kernels. Face f has the arcs arcBegin(f) to arcEnd(f) - 1.
layout(set = 0, binding = 1) readonly buffer ArcOffsets { uint arcOffsets[]; };
layout(set = 0, binding = 2) readonly buffer Neighbours { uint neighbours[]; };
layout(set = 0, binding = 3) readonly buffer Weights { float weights[]; };

uint arcBegin(uint face) { return arcOffsets[face]; }
uint arcEnd(uint face) { return arcOffsets[face + 1u]; }
