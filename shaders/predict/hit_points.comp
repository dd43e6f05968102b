#version 450
// The hit points of seeds. Marks the points that are outliers in the cone of the seed. A workgroup per seed, a ray per
// lane. The twin of src/predict/hit_points.cpp.
#extension GL_GOOGLE_include_directive : require
#include "shared/cone_hit.h"
#include "shared/cone_rules.h"
#include "shared/prediction_layout.h"
#include "shared/specialization_ids.h"

layout(local_size_x_id = kLocalSizeXId) in;  // Equal to kLanesPerCone.
layout(constant_id = kLanesPerConeId) const uint kLanesPerCone = 32u;
layout(constant_id = kRayCountId) const uint kRayCount = 30u;
layout(constant_id = kIsCgalId) const bool kIsCgal = false;
layout(constant_id = kLengthCountId) const uint kLengthCount = 30u;  // Equal to kRayCount.

layout(set = 0, binding = 0) readonly buffer Faces { uvec4 faceBlocks[]; };
layout(set = 0, binding = 1) readonly buffer Table { uvec4 tableBlocks[]; };  // See PredictionSeed.
layout(set = 0, binding = 2) readonly buffer Hits { uvec2 hits[]; };  // The bits of kRayCount ConeHits per place.
layout(set = 0, binding = 3) writeonly buffer Points { uvec4 pointBlocks[]; };
layout(push_constant) uniform Push { PointPush push; };

shared float lengths[kLengthCount];
shared float middles[2];

PredictionRay loadRay(uint ray) { return decodePredictionRay(tableBlocks[ray]); }

// Each lane computes the ranks of its valid rays among all valid rays, by the absolute differences of the lengths from
// `centre`. The differences of the two middle ranks determine the median (for an odd count the same one twice).
void findMiddles(uint lane, uint validCount, float centre) {
  for (uint ray = lane; ray < kRayCount; ray += kLanesPerCone) {
    if (lengths[ray] < 0.0) continue;
    const float own = abs(lengths[ray] - centre);
    uint rank = 0u;
    for (uint other = 0u; other < kRayCount; ++other) {
      const float difference = abs(lengths[other] - centre);
      rank += lengths[other] >= 0.0 && (difference < own || (difference == own && other < ray)) ? 1u : 0u;
    }
    if (rank == (validCount - 1u) / 2u) middles[0] = own;
    if (rank == validCount / 2u) middles[1] = own;
  }
}

float medianOfMiddles() { return 0.5 * (middles[0] + middles[1]); }

// The largest difference from the median of a length that is kept. Preconditions: a barrier after the lengths are
// written and, if kIsCgal, after findMiddles() with the median as the centre.
float outlierBound(uint validCount, float mean, float median) {
  if (kIsCgal) return push.outlierDeviations * medianOfMiddles();
  float variance = 0.0;
  for (uint ray = 0u; ray < kRayCount; ++ray) {
    const float l = lengths[ray];
    variance += l >= 0.0 ? (l - mean) * (l - mean) : 0.0;
  }
  const float deviation = sqrt(variance / float(validCount));
  return push.outlierDeviations * deviation + kOutlierSlack * median;
}

PredictionFace loadFace(uint face) {
  const uint block = face * kPredictionFaceBlockCount;
  return decodePredictionFace(faceBlocks[block], faceBlocks[block + 1u]);
}

PredictionSeed loadSeed(uint seed) { return decodePredictionSeed(tableBlocks[kRayCount + seed]); }

uint loadPlace(uint seed) { return tableBlocks[kRayCount + gl_NumWorkGroups.x + seed / 4u][seed % 4u]; }

void storePoint(uint index, PredictionPoint point) {
  const uint block = index * kPredictionPointBlockCount;
  pointBlocks[block] = uvec4(floatBitsToUint(point.position), point.face);
  pointBlocks[block + 1u] = uvec4(floatBitsToUint(point.normal), floatBitsToUint(point.solidAngleRatio));
}

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const PredictionSeed seed = loadSeed(gl_WorkGroupID.x);
  const PredictionFace face = loadFace(seed.face);
  const uint firstHit = loadPlace(gl_WorkGroupID.x) * kRayCount;
  const vec3 axis = -face.normal;
  const mat3 frame = mat3(seed.tangent, cross(axis, seed.tangent), axis);
  for (uint ray = lane; ray < kRayCount; ray += kLanesPerCone) {
    const uvec2 hit = hits[firstHit + ray];
    float validLength = -1.0;
    if (hit.y != kNoFace) {
      const vec3 normal = loadFace(hit.y).normal;
      const float cosine = dot(normal, kIsCgal ? -(frame * loadRay(ray).direction) : face.normal);
      if (!(cosine > push.falseHitCosine)) validLength = uintBitsToFloat(hit.x);
    }
    lengths[ray] = validLength;
  }
  if (lane == 0u) {  // Without a valid ray, findMiddles() does not write the middles.
    middles[0] = 0.0;
    middles[1] = 0.0;
  }
  barrier();
  uint validCount = 0u;
  float mean = 0.0;
  for (uint ray = 0u; ray < kRayCount; ++ray) {
    validCount += lengths[ray] >= 0.0 ? 1u : 0u;
    mean += max(lengths[ray], 0.0);
  }
  mean /= float(max(validCount, 1u));
  findMiddles(lane, validCount, 0.0);
  barrier();
  const float median = medianOfMiddles();
  barrier();
  if (kIsCgal) {
    findMiddles(lane, validCount, median);
    barrier();
  }
  const float bound = outlierBound(validCount, mean, median);
  const uint firstPoint = gl_WorkGroupID.x * (kRayCount + 1u);
  if (lane == 0u) storePoint(firstPoint, PredictionPoint(face.barycentre, seed.face, face.normal, median));
  for (uint ray = lane; ray < kRayCount; ray += kLanesPerCone) {
    const uvec2 hit = hits[firstHit + ray];
    PredictionPoint point = PredictionPoint(vec3(0.0), kNoFace, vec3(0.0), -1.0);
    if (hit.y != kNoFace) {
      const PredictionRay coneRay = loadRay(ray);
      const float hitDistance = uintBitsToFloat(hit.x);
      const float ratio = hitDistance * hitDistance * coneRay.solidAngle;
      const bool isInlier = lengths[ray] >= 0.0 && abs(hitDistance - median) <= bound;
      point = PredictionPoint(face.barycentre + hitDistance * (frame * coneRay.direction), hit.y,
                              loadFace(hit.y).normal, isInlier ? ratio : -ratio);
    }
    storePoint(firstPoint + 1u + ray, point);
  }
}
