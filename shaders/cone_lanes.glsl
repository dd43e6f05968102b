// The shape diameter of one seed face per cone: a workgroup holds the rays of one or more cones. Lane i of a cone
// traces the rays i, i + kLanesPerCone, ..., and the lanes reduce the lengths to one float. Needs FIND_NEAREST_HIT.
#include "shared/cone_layout.h"

layout(local_size_x_id = 7, local_size_y_id = 9) in;  // kLanesPerCone, kConesPerWorkgroup: an id is used once only.
layout(constant_id = 0) const uint kLanesPerCone = 32;
layout(constant_id = 1) const uint kConesPerWorkgroup = 1;
layout(constant_id = 2) const uint kRayCount = 30;
layout(constant_id = 3) const uint kIterationLimit = 8000;  // For one lane, over all its rays.
layout(constant_id = 4) const bool kWritesHits = false;

layout(set = 0, binding = 6) writeonly buffer Results { uint results[]; };
layout(set = 0, binding = 7) writeonly buffer Hits { uvec2 hits[]; };  // ConeHit, kRayCount per cone, if kWritesHits.
layout(push_constant) uniform Push { ConePush push; };

shared float lengths[kConesPerWorkgroup * kRayCount];
shared float middles[2 * kConesPerWorkgroup];
shared uint incompleteCounts[kConesPerWorkgroup];

#include "cone_rays.glsl"
#include "cone_value.glsl"

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint slot = gl_LocalInvocationID.y;
  const uint cone = gl_WorkGroupID.x * kConesPerWorkgroup + slot;
  const bool exists = cone < push.coneCount;
  const ConeOrigin start = loadOrigin(min(cone, push.coneCount - 1u));
  const vec3 axis = cross(start.tangent, start.bitangent);
  const uint base = slot * kRayCount;

  if (lane == 0u) incompleteCounts[slot] = 0u;
  barrier();
  uint iterationCount = 0u;
  for (uint ray = lane; ray < kRayCount; ray += kLanesPerCone) {
    const vec3 local = loadRay(ray).direction;
    const vec3 direction = local.x * start.tangent + local.y * start.bitangent + local.z * axis;
    const Hit hit = FIND_NEAREST_HIT(makeQuery(start.origin, direction, start.excludedFace), iterationCount);
    if (!hit.isComplete) atomicAdd(incompleteCounts[slot], 1u);
    lengths[base + ray] = validLength(hit, axis, direction);
    if (kWritesHits && exists) hits[cone * kRayCount + ray] = encodeHit(hit, direction);
  }
  barrier();
  uint validCount;
  float mean;
  findMiddles(base, slot, lane, validCount, mean);
  barrier();
  const float median = medianOf(slot);
  if (kIsCgal) {
    barrier();  // All lanes have read the median from `middles`.
    findMiddleDeviations(base, slot, lane, validCount, median);
    barrier();
  }
  if (lane == 0u && exists) {
    uint bits = kNoValueBits;
    if (validCount > 0u) bits = floatBitsToUint(weightedMean(base, slot, validCount, mean, median));
    results[cone] = incompleteCounts[slot] > 0u ? kIterationLimitBits : bits;
  }
}
