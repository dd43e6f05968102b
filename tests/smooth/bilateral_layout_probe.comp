#version 450
// Copies each field of the struct in shared/bilateral_layout.h to a word of its own.
#extension GL_GOOGLE_include_directive : require
#include "shared/bilateral_layout.h"

layout(local_size_x = 8) in;
layout(set = 0, binding = 0) writeonly buffer Words { uint words[]; };
layout(push_constant) uniform Push { BilateralPush push; };

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  words[0] = push.firstFace;
  words[1] = push.faceCount;
  words[2] = push.window;
}
