// Common parts of the traversals of both hierarchies. Needs the constants kFarAway and kIterationLimit.
#include "bvh_fetch.glsl"
#include "ray_frame.glsl"

const uint kNoPrimitive = 0xffffffffu;

struct Hit {
  float distance;
  uint primitive;   // kNoPrimitive: no hit.
  bool isComplete;  // False: the iteration limit ended the traversal.
};

vec3 invert(vec3 direction) {
  const vec3 tiny = vec3(1e-20);
  return 1.0 / mix(direction, mix(tiny, -tiny, lessThan(direction, vec3(0.0))), lessThan(abs(direction), tiny));
}

float distanceTo(DeviceTriangle triangle, RayFrame frame, vec3 origin) {
  return intersectTriangle(frame, triangle.v0 - origin, triangle.v1 - origin, triangle.v2 - origin);
}

// Replaces `hit` by the triangle in `primitive` if that is nearer. distance: negative where the ray misses the
// triangle.
void keepNearest(float distance, uint primitive, uint faceIndex, uint excludedFace, inout Hit hit) {
  if (distance >= 0.0 && distance < hit.distance && faceIndex != excludedFace) {
    hit.distance = distance;
    hit.primitive = primitive;
  }
}

void testTriangle(RayFrame frame, vec3 origin, uint primitive, uint excludedFace, inout Hit hit) {
  const DeviceTriangle triangle = loadTriangle(primitive);
  keepNearest(distanceTo(triangle, frame, origin), primitive, triangle.faceIndex, excludedFace, hit);
}

// slot0 and slot1 may be equal.
void testTriangles(RayFrame frame, vec3 origin, uint slot0, uint slot1, uint excludedFace, inout Hit hit) {
  const DeviceTriangle triangle0 = loadTriangle(slot0), triangle1 = loadTriangle(slot1);
  const float distance0 = distanceTo(triangle0, frame, origin), distance1 = distanceTo(triangle1, frame, origin);
  keepNearest(distance0, slot0, triangle0.faceIndex, excludedFace, hit);
  keepNearest(distance1, slot1, triangle1.faceIndex, excludedFace, hit);
}
