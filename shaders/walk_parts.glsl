// What the walks through both hierarchies share. Needs the constants kFarAway and kIterationLimit.
#include "bvh_fetch.glsl"
#include "ray_frame.glsl"

const uint kNoSlot = 0xffffffffu;

struct Hit {
  float distance;
  uint slot;        // kNoSlot: nothing was hit.
  bool isComplete;  // False: the iteration guard ended the walk.
};

vec3 invert(vec3 direction) {
  const vec3 tiny = vec3(1e-20);
  return 1.0 / mix(direction, mix(tiny, -tiny, lessThan(direction, vec3(0.0))), lessThan(abs(direction), tiny));
}

void testTriangle(RayFrame frame, vec3 origin, uint slot, uint excludedFace, inout Hit hit) {
  const DeviceTriangle triangle = loadTriangle(slot);
  const float t = intersectTriangle(frame, triangle.v0 - origin, triangle.v1 - origin, triangle.v2 - origin);
  if (t >= 0.0 && t < hit.distance && triangle.faceIndex != excludedFace) {
    hit.distance = t;
    hit.slot = slot;
  }
}
