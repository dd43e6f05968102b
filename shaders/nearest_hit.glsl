// The nearest hit of one query, in the hierarchy for which the kernel is compiled. The file that includes this one
// defines Query: ray_query.glsl or ball_query.glsl.
#include "binary_walk.glsl"
#include "wide_walk.glsl"

layout(constant_id = 6) const bool kIsWide = false;

// limit: distances from this on are no hits.
Hit findNearestHit(Query query, float limit, inout uint iterationCount) {
  if (kIsWide) return walkWide(query, limit, iterationCount);
  return walkBinary(query, limit, iterationCount);
}

#ifdef WALKS_TOGETHER
#include "packet_walk.glsl"

Hit findNearestHitTogether(Query query, float limit, inout uint iterationCount) {
  if (kIsWide) return walkWideTogether(query, limit, iterationCount);
  return walkBinaryTogether(query, limit, iterationCount);
}
#endif
