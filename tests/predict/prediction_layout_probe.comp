#version 450
// Copies every field of the structs of the prediction to `words`, in the order of their declaration.
#extension GL_GOOGLE_include_directive : require
#include "shared/prediction_layout.h"

layout(local_size_x = 8) in;
layout(set = 0, binding = 0) readonly buffer Blocks { uvec4 blocks[]; };  // A face, a ray, a seed and a point.
layout(set = 0, binding = 1) writeonly buffer Words { uint words[]; };
layout(push_constant) uniform Push { PredictionPush push; };

uint next = 0u;
void put(uint word) { words[next++] = word; }
void put(float word) { words[next++] = floatBitsToUint(word); }
void put(vec3 v) {
  put(v.x);
  put(v.y);
  put(v.z);
}

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  const PredictionFace face = decodePredictionFace(blocks[0], blocks[1]);
  put(face.barycentre), put(face.representative), put(face.normal), put(face.unused);
  const PredictionRay ray = decodePredictionRay(blocks[2]);
  put(ray.direction), put(ray.solidAngle);
  const PredictionSeed seed = decodePredictionSeed(blocks[3]);
  put(seed.tangent), put(seed.face);
  const PredictionPoint point = decodePredictionPoint(blocks[4], blocks[5]);
  put(point.position), put(point.face), put(point.normal), put(point.solidAngleRatio);
  put(push.itemCount), put(push.rayCount), put(push.minCosine), put(push.maxNormalCosine);
  put(push.minVersine), put(push.outlierDeviations), put(push.outlierSlack), put(push.distanceDeviation);
}
