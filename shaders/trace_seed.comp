#version 450
// The lengths of the rays of the cones, transposed: neighbouring lanes have the same few rays of neighbouring seeds,
// which visit nearly the same nodes. Workgroup (x, y) traces kLanesPerCone rays, from ray y kLanesPerCone on, of
// kConesPerWorkgroup cones. trace_reduce.comp computes the values from the lengths.
#extension GL_GOOGLE_include_directive : require
#include "shared/cone_layout.h"

layout(local_size_x_id = 7) in;  // kLanesPerCone * kConesPerWorkgroup
layout(constant_id = 0) const uint kLanesPerCone = 1;
layout(constant_id = 1) const uint kConesPerWorkgroup = 64;
layout(constant_id = 2) const uint kRayCount = 30;
layout(constant_id = 3) const uint kIterationLimit = 8000;
layout(constant_id = 4) const bool kWritesHits = false;

layout(set = 0, binding = 6) writeonly buffer Lengths { uint lengths[]; };  // Bits, coneCount per ray.
layout(set = 0, binding = 7) writeonly buffer Hits { uvec2 hits[]; };  // ConeHit, kRayCount per cone, if kWritesHits.
layout(push_constant) uniform Push { ConePush push; };

#include "cone_rays.glsl"

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint cone = gl_WorkGroupID.x * kConesPerWorkgroup + lane / kLanesPerCone;
  const uint ray = gl_WorkGroupID.y * kLanesPerCone + lane % kLanesPerCone;
  if (cone >= push.coneCount || ray >= kRayCount) return;
  const ConeOrigin start = loadOrigin(cone);
  const vec3 axis = cross(start.tangent, start.bitangent);
  const vec3 local = loadRay(ray).direction;
  const vec3 direction = local.x * start.tangent + local.y * start.bitangent + local.z * axis;
  uint iterationCount = 0u;
  const Hit hit = findNearestHit(makeQuery(start.origin, direction, start.excludedFace), iterationCount);
  const float length = validLength(hit, axis, direction);
  lengths[ray * push.coneCount + cone] = hit.isComplete ? floatBitsToUint(length) : kIterationLimitBits;
  if (kWritesHits) hits[cone * kRayCount + ray] = encodeHit(hit, direction);
}
