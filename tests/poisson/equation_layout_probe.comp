#version 450
// Copies each field of the structs in shared/equation_layout.h to a word of its own.
#extension GL_GOOGLE_include_directive : require
#include "shared/equation_layout.h"

layout(local_size_x = 8) in;
layout(set = 0, binding = 0) readonly buffer Starts { EquationStart starts[2]; };
layout(set = 0, binding = 1) writeonly buffer Words { uint words[]; };
layout(push_constant) uniform Push { EquationPush push; };

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  for (uint i = 0u; i < 2u; ++i) {
    words[3u * i] = floatBitsToUint(starts[i].base);
    words[3u * i + 1u] = floatBitsToUint(starts[i].difference);
    words[3u * i + 2u] = starts[i].flags;
  }
  words[6] = push.faceCount;
  words[7] = push.workgroupCount;
  words[8] = floatBitsToUint(push.scale);
}
