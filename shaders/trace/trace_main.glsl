// The main function of the kernels that trace rays: the lengths of the rays of cones, which trace_reduce.comp reduces
// to values. A kernel includes this file last, after it has defined the walk `Hit findNearestHit(Query query)`. The
// files wide_nodes.glsl and ray_query.glsl have what a walk needs.
#include "shared/cone_hit.h"
#include "shared/cone_rules.h"

const float kDropped = -1.0;  // The length of an invalid ray.

ConeOrigin loadOrigin(uint cone) {
  const int t = int(cone * kConeOriginTexelCount);
  return decodeConeOrigin(imageLoad(originTexels, t), imageLoad(originTexels, t + 1), imageLoad(originTexels, t + 2));
}

// The distance of a hit without the addition for the outer side in intersectTriangle().
float distanceOf(Hit hit, vec3 normal, vec3 direction) {
  return dot(normal, direction) < 0.0 ? hit.distance - kOuterSideFactor * push.contactDistance : hit.distance;
}

// The length of a ray; kDropped for a miss and for a false hit. An angle decides whether a hit is false. Paper: the
// angle between the normals of hit face and seed face (minus the axis). Cgal: the angle between the ray and the normal
// of the hit face.
float validLength(Hit hit, vec3 axis, vec3 direction) {
  if (hit.primitive == kNoPrimitive) return kDropped;
  const DeviceTriangle triangle = loadTriangle(hit.primitive);
  const vec3 normal = decodeNormal(triangle.normalU, triangle.normalV);
  return -dot(normal, kIsCgal ? direction : axis) > push.falseHitCosine ? kDropped : distanceOf(hit, normal, direction);
}

uvec2 encodeHit(Hit hit, vec3 direction) {
  if (hit.primitive == kNoPrimitive) return uvec2(kMissDistanceBits, kNoFace);
  const DeviceTriangle triangle = loadTriangle(hit.primitive);
  const vec3 normal = decodeNormal(triangle.normalU, triangle.normalV);
  return uvec2(floatBitsToUint(distanceOf(hit, normal, direction)), triangle.faceIndex);
}

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint cone = gl_WorkGroupID.x * kConesPerWorkgroup + lane / kLanesPerCone;
  const uint ray = gl_WorkGroupID.y * kLanesPerCone + lane % kLanesPerCone;
  if (cone >= push.coneCount || ray >= kRayCount) return;
  const ConeOrigin start = loadOrigin(cone);
  const vec3 axis = cross(start.tangent, start.bitangent);
  const vec3 local = decodeConeRay(imageLoad(rayTexels, int(ray))).direction;
  const vec3 direction = local.x * start.tangent + local.y * start.bitangent + local.z * axis;
  const Hit hit = findNearestHit(makeQuery(start.origin, direction, start.excludedFace));
  const float rayLength = validLength(hit, axis, direction);
  lengths[ray * push.coneCount + cone] = hit.isComplete ? floatBitsToUint(rayLength) : kIterationLimitBits;
  if (kWritesHits) hits[cone * kRayCount + ray] = encodeHit(hit, direction);
}
