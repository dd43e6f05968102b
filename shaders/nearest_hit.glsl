// The nearest hit of one ray, in the hierarchy for which the kernel is compiled.
#include "walk_parts.glsl"

#include "binary_walk.glsl"
#include "wide_walk.glsl"

layout(constant_id = 6) const bool kIsWide = false;

Hit findNearestHit(vec3 origin, vec3 direction, uint excludedFace, inout uint iterationCount) {
  if (kIsWide) return walkWide(origin, direction, excludedFace, iterationCount);
  return walkBinary(origin, direction, excludedFace, iterationCount);
}

#ifdef WALKS_TOGETHER
#include "packet_walk.glsl"

Hit findNearestHitTogether(vec3 origin, vec3 direction, uint excludedFace, inout uint iterationCount) {
  if (kIsWide) return walkWideTogether(origin, direction, excludedFace, iterationCount);
  return walkBinaryTogether(origin, direction, excludedFace, iterationCount);
}
#endif
