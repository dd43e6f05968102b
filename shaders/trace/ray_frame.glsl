#include "shared/cone_rules.h"

// An orthonormal frame around a ray, for the computation of its hits (the twin of src/trace/nearest_hit.h).
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

// Coordinates across the ray, which depend on the vertex and the ray only. `precise` makes the coordinates and edge
// functions bit-identical in both triangles of an edge. Therefore no ray passes between the triangles.
vec2 acrossRay(RayFrame frame, vec3 v) {
  precise vec2 p =
      vec2(frame.u.x * v.x + frame.u.y * v.y + frame.u.z * v.z, frame.w.x * v.x + frame.w.y * v.y + frame.w.z * v.z);
  return p;
}

// The distance along the ray to the triangle; negative if the ray misses the triangle or hits it within the contact
// distance (Cone in src/cone/cone.h). On the outer side, kOuterSideFactor contact distances are added. Corners are
// relative to the origin of the ray. Rays hit both sides and the edges of the triangle. The distance is computed from
// the plane with `normal`, of any length: interpolation between the corners is inexact in long, narrow triangles.
float intersectTriangle(RayFrame frame, vec3 v0, vec3 v1, vec3 v2, vec3 normal, float contactDistance) {
  const vec2 a = acrossRay(frame, v0);
  const vec2 b = acrossRay(frame, v1);
  const vec2 c = acrossRay(frame, v2);
  precise const float edgeA = c.x * b.y - c.y * b.x;
  precise const float edgeB = a.x * c.y - a.y * c.x;
  precise const float edgeC = b.x * a.y - b.y * a.x;
  const float det = edgeA + edgeB + edgeC;
  // The point is inside if each edge function is 0 or has the sign of the sum of the edge functions.
  const uvec3 turned = floatBitsToUint(vec3(edgeA, edgeB, edgeC)) ^ (floatBitsToUint(det) & 0x80000000u);
  const bool inside = all(greaterThanEqual(uintBitsToFloat(turned), vec3(0.0))) && det != 0.0;
  const float slope = dot(normal, frame.direction);
  const float t = dot(normal, v0) / slope;
  return inside && t >= contactDistance ? t + (slope < 0.0 ? kOuterSideFactor * contactDistance : 0.0) : -1.0;
}
