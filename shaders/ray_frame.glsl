#include "shared/cone_rules.h"

// An orthonormal frame around a ray, in which its hits are computed (the twin of src/trace/nearest_hit.h).
struct RayFrame {
  vec3 u, w, direction;
};

// Duff et al. 2017.
RayFrame makeRayFrame(vec3 direction) {
  const float s = direction.z < 0.0 ? -1.0 : 1.0;
  const float a = -1.0 / (s + direction.z);
  const float b = direction.x * direction.y * a;
  return RayFrame(vec3(1.0 + s * direction.x * direction.x * a, s * b, -s * direction.x),
                  vec3(b, s + direction.y * direction.y * a, -direction.y), direction);
}

// A vertex in the frame of the ray depends on the vertex and the ray only. `precise` makes it, and the edge functions
// computed from it, bit-identical in both triangles of an edge, so that no ray passes between them.
vec3 toRayFrame(RayFrame frame, vec3 v) {
  precise vec3 p =
      vec3(frame.u.x * v.x + frame.u.y * v.y + frame.u.z * v.z, frame.w.x * v.x + frame.w.y * v.y + frame.w.z * v.z,
           frame.direction.x * v.x + frame.direction.y * v.y + frame.direction.z * v.z);
  return p;
}

// The distance along the ray to the triangle (relative to the origin of the ray), or a negative number where the ray
// misses it or touches it within the contact distance (Cone in src/cone/cone.h), which is added on the outer side. Rays
// hit both sides and the edges of the triangle.
float intersectTriangle(RayFrame frame, vec3 v0, vec3 v1, vec3 v2, float contactDistance) {
  const vec3 a = toRayFrame(frame, v0);
  const vec3 b = toRayFrame(frame, v1);
  const vec3 c = toRayFrame(frame, v2);
  precise const float edgeA = c.x * b.y - c.y * b.x;
  precise const float edgeB = a.x * c.y - a.y * c.x;
  precise const float edgeC = b.x * a.y - b.y * a.x;
  const float det = edgeA + edgeB + edgeC;
  // Inside if each of the three is 0 or has the sign of their sum.
  const uvec3 turned = floatBitsToUint(vec3(edgeA, edgeB, edgeC)) ^ (floatBitsToUint(det) & 0x80000000u);
  const bool inside = all(greaterThanEqual(uintBitsToFloat(turned), vec3(0.0))) && det != 0.0;
  const float t = (edgeA * a.z + edgeB * b.z + edgeC * c.z) / det;
  return inside && t >= contactDistance ? t + (det > 0.0 ? kOuterSideFactor * contactDistance : 0.0) : -1.0;
}
