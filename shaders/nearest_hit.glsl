// The nearest hit of one ray, in the hierarchy for which the kernel is compiled.
#include "walk_parts.glsl"

#include "ray_query.glsl"

#include "binary_walk.glsl"
#include "wide_walk.glsl"

layout(constant_id = 6) const bool kIsWide = false;

Hit findNearestHit(Query query, inout uint iterationCount) {
  if (kIsWide) return walkWide(query, iterationCount);
  return walkBinary(query, iterationCount);
}

#ifdef WALKS_TOGETHER
#include "packet_walk.glsl"

Hit findNearestHitTogether(Query query, inout uint iterationCount) {
  if (kIsWide) return walkWideTogether(query, iterationCount);
  return walkBinaryTogether(query, iterationCount);
}
#endif
