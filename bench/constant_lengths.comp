#version 450
// Replaces shaders/trace/trace_rays.comp in bench/constant_backend.cpp. Does not trace: lengths and hits are a smooth
// function of the origin, so that only writing them takes time.
#extension GL_GOOGLE_include_directive : require
#include "shared/cone_layout.h"
#include "shared/specialization_ids.h"

layout(local_size_x_id = kLocalSizeXId) in;
layout(constant_id = kLanesPerConeId) const uint kLanesPerCone = 1;
layout(constant_id = kConesPerWorkgroupId) const uint kConesPerWorkgroup = 64;
layout(constant_id = kRayCountId) const uint kRayCount = 30;
layout(constant_id = kWritesHitsId) const bool kWritesHits = false;

layout(set = 0, binding = 5, rgba32ui) uniform readonly uimageBuffer originTexels;
layout(set = 0, binding = 6) writeonly buffer Lengths { uint lengths[]; };
layout(set = 0, binding = 7) writeonly buffer Hits { uvec2 hits[]; };
layout(push_constant) uniform Push { ConePush push; };

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint cone = gl_WorkGroupID.x * kConesPerWorkgroup + lane / kLanesPerCone;
  const uint ray = gl_WorkGroupID.y * kLanesPerCone + lane % kLanesPerCone;
  if (cone >= push.coneCount || ray >= kRayCount) return;
  const uvec4 origin = imageLoad(originTexels, int(cone * kConeOriginTexelCount));
  const uint lengthBits = floatBitsToUint(0.25 + 0.125 * uintBitsToFloat(origin.x));
  lengths[ray * push.coneCount + cone] = lengthBits;
  if (kWritesHits) hits[cone * kRayCount + ray] = uvec2(lengthBits, origin.w);
}
