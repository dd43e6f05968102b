#version 450
// For benchmarks of the host: values and hits of a smooth function of the origin instead of those of rays, in the time
// that writing them takes. A workgroup per cone or a few cones, as trace_cone.comp.
#extension GL_GOOGLE_include_directive : require
#include "shared/cone_layout.h"

layout(local_size_x_id = 7, local_size_y_id = 9) in;  // kLanesPerCone, kConesPerWorkgroup
layout(constant_id = 0) const uint kLanesPerCone = 32;
layout(constant_id = 1) const uint kConesPerWorkgroup = 1;
layout(constant_id = 2) const uint kRayCount = 30;
layout(constant_id = 4) const bool kWritesHits = false;

layout(set = 0, binding = 5, rgba32ui) uniform readonly uimageBuffer originTexels;
layout(set = 0, binding = 6) writeonly buffer Results { uint results[]; };
layout(set = 0, binding = 7) writeonly buffer Hits { uvec2 hits[]; };
layout(push_constant) uniform Push { ConePush push; };

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint cone = gl_WorkGroupID.x * kConesPerWorkgroup + gl_LocalInvocationID.y;
  if (cone >= push.coneCount) return;
  const uvec4 origin = imageLoad(originTexels, int(cone * kConeOriginTexelCount));
  const uint length = floatBitsToUint(0.25 + 0.125 * uintBitsToFloat(origin.x));
  if (lane == 0u) results[cone] = length;
  if (kWritesHits)
    for (uint ray = lane; ray < kRayCount; ray += kLanesPerCone) hits[cone * kRayCount + ray] = uvec2(length, origin.w);
}
