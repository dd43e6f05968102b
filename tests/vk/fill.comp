#version 450
// Writes value + index into every word of a buffer.
#extension GL_GOOGLE_include_directive : require
#include "shared/specialization_ids.h"
layout(local_size_x_id = kLocalSizeXId) in;
layout(set = 0, binding = 0) writeonly buffer Words { uint words[]; };
layout(push_constant) uniform Push {
  uint value;
  uint wordCount;
}
push;
void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < push.wordCount) words[i] = push.value + i;
}
