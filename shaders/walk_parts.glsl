// What the walks through both hierarchies share. Needs the constants kFarAway and kIterationLimit.
#include "bvh_fetch.glsl"
#include "ray_frame.glsl"

const uint kNoSlot = 0xffffffffu;

struct Hit {
  float distance;
  uint slot;        // kNoSlot: nothing was hit.
  bool isComplete;  // False: the iteration guard ended the walk.
};

// Boxes are left three roundings later than computed (Ize 2013).
const float kExitMargin = 1.0 + 6.0 * 5.9604645e-8;

vec3 invert(vec3 direction) {
  const vec3 tiny = vec3(1e-20);
  return 1.0 / mix(direction, mix(tiny, -tiny, lessThan(direction, vec3(0.0))), lessThan(abs(direction), tiny));
}
