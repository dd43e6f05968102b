#version 450
// Copies the hits of a chunk of cones to the places of their seeds among the hits of all seeds, a hit as its two words.
#extension GL_GOOGLE_include_directive : require
#include "shared/cone_hit.h"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = 0) readonly buffer Hits { uvec2 hits[]; };
layout(set = 0, binding = 1) readonly buffer Places { uint places[]; };  // Place of each cone in the batch.
layout(set = 0, binding = 2) writeonly buffer Stored { uvec2 stored[]; };
layout(push_constant) uniform Push { HitStorePush push; };

void main() {
  const uint first = gl_WorkGroupID.x * gl_WorkGroupSize.x * kStoredHitsPerLane + gl_LocalInvocationID.x;
  for (uint i = 0u; i < kStoredHitsPerLane; ++i) {
    const uint hit = first + i * gl_WorkGroupSize.x;
    if (hit >= push.hitCount) return;
    const uint cone = hit / push.rayCount;
    stored[(push.seedCount + places[cone]) * push.rayCount + (hit - cone * push.rayCount)] = hits[hit];
  }
}
