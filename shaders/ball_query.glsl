// The query of the traversals for a ball that touches a face from inside and shrinks until no opposing wall is inside
// (the twin of src/trace/reference_balls.cpp). Hit::distance is the diameter of the ball. Needs `push`.
#include "wide_boxes.glsl"

// Wide: DeviceBvh::childNormals, fetched as the hierarchy (bvh_fetch.glsl): from this image, or from the end of
// nodeBlocks, because some devices allow four storage buffers only.
layout(set = 0, binding = 4, rgba32ui) uniform readonly uimageBuffer childNormalTexels;

uvec4 fetchChildNormals(uint index) {
  if (kFetchesTexels) return imageLoad(childNormalTexels, int(index));
  return nodeBlocks[push.childNormalStart + index];
}

struct Query {
  vec3 origin, axis;
  bvec3 isNegative;  // Of the axis.
  uint excludedFace;
  // NormalBoundsTest of src/bvh/normal_bounds.h: a normal within the bounds may be that of an opposing wall if the sum
  // of the factors times the bounds at the shifts is at most the limit.
  vec3 normalFactors;
  uvec3 normalShifts;
  float normalLimit;
};

Query makeQuery(vec3 origin, vec3 axis, uint excludedFace) {
  const vec3 normal = -axis;
  const uvec3 lowerShifts = uvec3(0u, 2u, 4u) * kNormalBoundsBits;
  return Query(origin, axis, lessThan(axis, vec3(0.0)), excludedFace, normal * (2.0 / float(kNormalBoundsMask)),
               mix(lowerShifts, lowerShifts + kNormalBoundsBits, lessThan(normal, vec3(0.0))),
               push.wallCosine + normal.x + normal.y + normal.z + 1e-5);
}

vec3 centreOf(Query query, float diameter) { return query.origin + 0.5 * diameter * query.axis; }

vec4 normalComponents(uvec4 bounds, uint shift) { return vec4(ivec4(bounds >> shift & kNormalBoundsMask)); }

// Which of four bounds may hold the normal of an opposing wall.
bvec4 mayOppose(uvec4 bounds, Query query) {
  const vec4 sum = query.normalFactors.x * normalComponents(bounds, query.normalShifts.x) +
                   query.normalFactors.y * normalComponents(bounds, query.normalShifts.y) +
                   query.normalFactors.z * normalComponents(bounds, query.normalShifts.z);
  return lessThanEqual(sum, vec4(query.normalLimit));
}

// Squared distance of the centre from the box; kFarAway where the box is outside of the ball or has no opposing wall.
float enterBox(vec3 boxMin, vec3 boxMax, uint normalBounds, Query query, float diameter) {
  const vec3 centre = centreOf(query, diameter);
  const vec3 gap = max(max(boxMin - centre, centre - boxMax), vec3(0.0));
  const float squared = dot(gap, gap);
  const bool isInside = squared < 0.25 * diameter * diameter && mayOppose(uvec4(normalBounds), query).x;
  return isInside ? squared : kFarAway;
}

// Distances of a coordinate from four intervals. Compared by their bits, as in ray_query.glsl: at most one of the two
// differences is positive, and the bits of negative floats are negative integers.
vec4 gapsOf(vec4 low, vec4 high) {
  return intBitsToFloat(max(max(floatBitsToInt(low), floatBitsToInt(-high)), ivec4(0)));
}

// A nibble of ones for each of the four boxes that are in the ball and may have an opposing wall. start: the origin of
// the node minus the centre.
uint enterBoxes(uvec3 lower, uvec3 upper, uvec4 normalBounds, Query query, vec3 perByte, vec3 start, float diameter) {
  const vec4 x = gapsOf(distancesTo(lower.x, perByte.x, start.x), distancesTo(upper.x, perByte.x, start.x));
  const vec4 y = gapsOf(distancesTo(lower.y, perByte.y, start.y), distancesTo(upper.y, perByte.y, start.y));
  const vec4 z = gapsOf(distancesTo(lower.z, perByte.z, start.z), distancesTo(upper.z, perByte.z, start.z));
  const bvec4 isNear = lessThan(x * x + y * y + z * z, vec4(0.25 * diameter * diameter));
  const bvec4 opposes = mayOppose(normalBounds, query);
  return (isNear.x && opposes.x ? 0xfu : 0u) | (isNear.y && opposes.y ? 0xf0u : 0u) |
         (isNear.z && opposes.z ? 0xf00u : 0u) | (isNear.w && opposes.w ? 0xf000u : 0u);
}

// The nibbles of childBits of the children to enter; the other nibbles are 0.
uint enterChildren(uint index, DeviceWideNode node, Query query, float diameter) {
  const vec3 perByte = stepsOf(node);
  const vec3 start = node.origin - centreOf(query, diameter);
  const uint t = 2u * index;
  return (enterBoxes(uvec3(node.x.x, node.y.x, node.z.x), uvec3(node.x.z, node.y.z, node.z.z), fetchChildNormals(t),
                     query, perByte, start, diameter) |
          enterBoxes(uvec3(node.x.y, node.y.y, node.z.y), uvec3(node.x.w, node.y.w, node.z.w),
                     fetchChildNormals(t + 1u), query, perByte, start, diameter)
              << 16) &
         node.childBits;
}

// The least diameter over the edge from a to b, or kFarAway; see leastOnEdge() of src/cone/thickness.cpp.
float leastOnEdge(vec3 axis, vec3 a, vec3 b) {
  const vec3 edge = b - a;
  const float height = dot(a, axis);
  const float slope = dot(edge, axis);
  const float square = dot(edge, edge);
  const float root = sqrt(square) * length(height * edge - slope * a);
  const float ahead = (slope * dot(a, a) - 2.0 * height * dot(a, edge)) / max(height * square + root, 1e-30);
  const float behind = slope > 0.0 ? (root - height * square) / max(slope * square, 1e-30) : 0.0;
  const vec3 p = a + clamp(height >= 0.0 ? ahead : behind, 0.0, 1.0) * edge;
  const float depth = dot(p, axis);
  return depth > 0.0 ? dot(p, p) / depth : kFarAway;
}

// leastDiameter() of src/cone/thickness.h; kFarAway where no ball touches the triangle.
float leastDiameter(vec3 axis, vec3 normal, vec3 a, vec3 b, vec3 c) {
  const float offset = dot(normal, a);
  const float side = offset < 0.0 ? -1.0 : 1.0;
  const float radius = abs(offset) / max(1.0 + side * dot(normal, axis), 1e-10);
  const vec3 p = radius * (axis + side * normal);
  const bool isInside = dot(cross(b - a, p - a), normal) >= 0.0 && dot(cross(c - b, p - b), normal) >= 0.0 &&
                        dot(cross(a - c, p - c), normal) >= 0.0;
  const float onEdges = min(min(leastOnEdge(axis, a, b), leastOnEdge(axis, b, c)), leastOnEdge(axis, c, a));
  return isInside ? 2.0 * radius : onEdges;
}

// Negative where the triangle is no opposing wall.
float diameterBy(DeviceTriangle triangle, Query query) {
  const vec3 normal = decodeNormal(triangle.normalU, triangle.normalV);
  if (-dot(normal, query.axis) > push.wallCosine) return -1.0;
  return leastDiameter(query.axis, normal, triangle.v0 - query.origin, triangle.v1 - query.origin,
                       triangle.v2 - query.origin);
}

void testTriangle(Query query, uint primitive, inout Hit hit) {
  const DeviceTriangle triangle = loadTriangle(primitive);
  keepNearest(diameterBy(triangle, query), primitive, triangle.faceIndex, query.excludedFace, hit);
}

void testTriangles(Query query, uint slot0, uint slot1, inout Hit hit) {
  testTriangle(query, slot0, hit);
  if (slot1 != slot0) testTriangle(query, slot1, hit);
}
