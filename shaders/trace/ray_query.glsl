// The boxes that a ray enters, and the triangles that it hits.
#include "bvh_fetch.glsl"
#include "ray_bindings.glsl"
#include "ray_frame.glsl"

const uint kNoPrimitive = 0xffffffffu;
const float kFarAway = 1e30;  // Greater than any distance in normalised coordinates.

struct Hit {
  float distance;
  uint primitive;   // kNoPrimitive: no hit.
  bool isComplete;  // False: the iteration limit ended the traversal.
};

// Replaces `hit` by the triangle in `primitive` if the triangle is nearer. hitDistance: negative if the ray misses the
// triangle.
void keepNearest(float hitDistance, uint primitive, uint faceIndex, uint excludedFace, inout Hit hit) {
  if (hitDistance >= 0.0 && hitDistance < hit.distance && faceIndex != excludedFace) {
    hit.distance = hitDistance;
    hit.primitive = primitive;
  }
}

struct Query {
  RayFrame frame;
  vec3 origin, inverseDirection;
  bvec3 isNegative;  // Whether each component of the direction is negative.
  uint octantShift;  // 4 * octant, where the bits of the octant are isNegative.
  uint excludedFace;
};

uint octantShiftOf(bvec3 isNegative) {
  const uvec3 bits = uvec3(isNegative);
  return bits.x << 2 | bits.y << 3 | bits.z << 4;
}

vec3 invert(vec3 direction) {
  const vec3 tiny = vec3(1e-20);
  return 1.0 / mix(direction, mix(tiny, -tiny, lessThan(direction, vec3(0.0))), lessThan(abs(direction), tiny));
}

Query makeQuery(vec3 origin, vec3 direction, uint excludedFace) {
  const bvec3 isNegative = lessThan(direction, vec3(0.0));
  return Query(makeRayFrame(direction), origin, invert(direction), isNegative, octantShiftOf(isNegative), excludedFace);
}

float distanceTo(DeviceTriangle triangle, Query query) {
  const vec3 origin = query.origin;
  return intersectTriangle(query.frame, triangle.v0 - origin, triangle.v1 - origin, triangle.v2 - origin,
                           octahedralDirection(triangle.normalU, triangle.normalV), push.contactDistance);
}

void testTriangle(Query query, uint primitive, inout Hit hit) {
  const DeviceTriangle triangle = loadTriangle(primitive);
  keepNearest(distanceTo(triangle, query), primitive, triangle.faceIndex, query.excludedFace, hit);
}

// slot0 and slot1 may be equal.
void testTriangles(Query query, uint slot0, uint slot1, inout Hit hit) {
  const DeviceTriangle triangle0 = loadTriangle(slot0), triangle1 = loadTriangle(slot1);
  const float distance0 = distanceTo(triangle0, query), distance1 = distanceTo(triangle1, query);
  keepNearest(distance0, slot0, triangle0.faceIndex, query.excludedFace, hit);
  keepNearest(distance1, slot1, triangle1.faceIndex, query.excludedFace, hit);
}

// Distances to the planes of four boxes on one axis: byte * perByte + start. kMantissaBytes: the float with the byte as
// the upper bits of its mantissa is 1 + byte / 256. kMaskedBytes: bytes 0 to 2 are masked but not shifted, and the
// scale corrects the missing shift. Signed conversions are faster than unsigned ones.
vec4 distancesTo(uint bytes, float perByte, float start) {
  if (kNodeArithmetic == kMantissaBytes) {
    const uvec4 mantissas = uvec4(bytes << 15, bytes << 7, bytes >> 1, bytes >> 9) & 0x007f8000u;
    return uintBitsToFloat(mantissas | 0x3f800000u) * (256.0 * perByte) + (start - 256.0 * perByte);
  }
  if (kNodeArithmetic == kShiftedBytes)
    return vec4(bytes & 0xffu, bytes >> 8 & 0xffu, bytes >> 16 & 0xffu, bytes >> 24) * perByte + start;
  const vec4 planes = vec4(int(bytes & 0xffu), int(bytes & 0xff00u), int(bytes & 0xff0000u), int(bytes >> 24));
  return planes * (perByte * vec4(1.0, 1.0 / 256.0, 1.0 / 65536.0, 1.0)) + start;
}

// For each axis, the length of one unit of the bytes in which a node stores its boxes.
vec3 stepsOf(DeviceWideNode node) {
  return uintBitsToFloat(uvec3(node.exponents << 23, node.exponents << 15, node.exponents << 7) & 0x7f800000u);
}

// A nibble of ones for each of the four boxes that the ray enters before `limit`. Distances are compared as integers,
// by their bits. Non-negative floats have the same order as integers, negative floats the reverse order. A box behind
// the origin has negative distances only. As integers, its exit is then below its entry, so that the ray does not enter
// the box. On llvmpipe a minimum of floats takes three instructions because of NaNs, which do not occur here.
// kWideBoxMargin covers rounding.
uint enterBoxes(uvec3 near, uvec3 far, vec3 perByte, vec3 start, float limit) {
  const ivec4 enter = max(max(floatBitsToInt(distancesTo(near.x, perByte.x, start.x)),
                              floatBitsToInt(distancesTo(near.y, perByte.y, start.y))),
                          floatBitsToInt(distancesTo(near.z, perByte.z, start.z)));
  const ivec4 inside = min(min(floatBitsToInt(distancesTo(far.x, perByte.x, start.x)),
                               floatBitsToInt(distancesTo(far.y, perByte.y, start.y))),
                           floatBitsToInt(distancesTo(far.z, perByte.z, start.z)));
  const ivec4 leave = min(inside, ivec4(floatBitsToInt(limit)));
  return (enter.x <= leave.x ? 0xfu : 0u) | (enter.y <= leave.y ? 0xf0u : 0u) | (enter.z <= leave.z ? 0xf00u : 0u) |
         (enter.w <= leave.w ? 0xf000u : 0u);
}

// The nibbles of childBits of the children that the ray enters before `limit`. Other nibbles are 0.
uint enterChildren(DeviceWideNode node, Query query, float limit) {
  const vec3 perByte = stepsOf(node) * query.inverseDirection;
  const vec3 start = (node.origin - query.origin) * query.inverseDirection;
  const uvec4 x = query.isNegative.x ? node.x.zwxy : node.x;
  const uvec4 y = query.isNegative.y ? node.y.zwxy : node.y;
  const uvec4 z = query.isNegative.z ? node.z.zwxy : node.z;
  return (enterBoxes(uvec3(x.x, y.x, z.x), uvec3(x.z, y.z, z.z), perByte, start, limit) |
          enterBoxes(uvec3(x.y, y.y, z.y), uvec3(x.w, y.w, z.w), perByte, start, limit) << 16) &
         node.childBits;
}
