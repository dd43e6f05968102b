// Origins, directions, lengths and hits of the rays of cones, for every kernel that traces them. Needs `push`.
#include "shared/cone_hit.h"
#include "shared/cone_layout.h"
#include "shared/cone_rules.h"

layout(set = 0, binding = 4, rgba32ui) uniform readonly uimageBuffer rayTexels;
layout(set = 0, binding = 5, rgba32ui) uniform readonly uimageBuffer originTexels;

layout(constant_id = 8) const bool kIsCgal = false;  // The definition of the shape diameter; otherwise the paper's.

const float kDropped = -1.0;  // The length of an invalid ray.

ConeRay loadRay(uint ray) { return decodeConeRay(imageLoad(rayTexels, int(ray))); }

ConeOrigin loadOrigin(uint cone) {
  const int t = int(cone * kConeOriginTexelCount);
  return decodeConeOrigin(imageLoad(originTexels, t), imageLoad(originTexels, t + 1), imageLoad(originTexels, t + 2));
}

#include "ray_query.glsl"

#include "wide_walk.glsl"
#ifdef WALKS_TOGETHER
#include "packet_walk.glsl"
#endif

// Without what intersectTriangle() adds on the outer side.
float distanceOf(Hit hit, vec3 normal, vec3 direction) {
  return dot(normal, direction) < 0.0 ? hit.distance - kOuterSideFactor * push.contactDistance : hit.distance;
}

// The length of a ray; kDropped where it hits nothing, or where the hit is false: by the angle between the normal of
// the face and that of the seed (minus the axis), or between the normal of the face and the ray.
float validLength(Hit hit, vec3 axis, vec3 direction) {
  if (hit.primitive == kNoPrimitive) return kDropped;
  const DeviceTriangle triangle = loadTriangle(hit.primitive);
  const vec3 normal = decodeNormal(triangle.normalU, triangle.normalV);
  return -dot(normal, kIsCgal ? direction : axis) > push.falseHitCosine ? kDropped : distanceOf(hit, normal, direction);
}

uvec2 encodeHit(Hit hit, vec3 direction) {
  if (hit.primitive == kNoPrimitive) return uvec2(kMissDistanceBits, kNoFace);
  const DeviceTriangle triangle = loadTriangle(hit.primitive);
  const vec3 normal = decodeNormal(triangle.normalU, triangle.normalV);
  return uvec2(floatBitsToUint(distanceOf(hit, normal, direction)), triangle.faceIndex);
}
