#version 450
// One pass of bilateral smoothing, an invocation per face. Twin of src/post/ring_window.cpp and bilateral.cpp.
#extension GL_GOOGLE_include_directive : require
#include "shared/bilateral_layout.h"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = 0) readonly buffer Offsets { uint offsets[]; };
layout(set = 0, binding = 1) readonly buffer Neighbours { uint neighbours[]; };
layout(set = 0, binding = 2) readonly buffer From { float values[]; };
layout(set = 0, binding = 3) writeonly buffer To { float smoothed[]; };
layout(push_constant) uniform Push { BilateralPush push; };

uint faces[kMaxWindowFaceCount];
uint ringEnds[kMaxBilateralWindow + 1u];

bool isKnown(uint face, uint begin, uint end) {
  for (uint i = begin; i < end; ++i)
    if (faces[i] == face) return true;
  return false;
}

// Fills `faces` and `ringEnds` and returns how many faces there are.
uint gatherWindow(uint face) {
  faces[0] = face;
  ringEnds[0] = 1u;
  uint count = 1u, arcsLeft = kMaxWindowArcCount;
  uint known = 0u, parentBegin = 0u;
  for (uint ring = 1u; ring <= push.window; ++ring) {
    const uint parentEnd = count;
    for (uint parent = parentBegin; parent < parentEnd; ++parent) {
      const uint rowEnd = offsets[faces[parent] + 1u];
      for (uint arc = offsets[faces[parent]]; arc < rowEnd; ++arc) {
        if (arcsLeft == 0u || count == kMaxWindowFaceCount) break;
        --arcsLeft;
        const uint neighbour = neighbours[arc];
        if (!isKnown(neighbour, known, count)) faces[count++] = neighbour;
      }
    }
    ringEnds[ring] = count;
    known = parentBegin;
    parentBegin = parentEnd;
  }
  return count;
}

float smoothedValue(uint face, float value) {
  const uint count = gatherWindow(face);
  float differences[kMaxWindowFaceCount];
  float largest = 0.0;
  for (uint i = 0u; i < count; ++i) {
    const float other = values[faces[i]];
    differences[i] = other < kNoScaledValue ? other - value : kNoScaledValue;
    if (differences[i] < kNoScaledValue) largest = max(largest, abs(differences[i]));
  }
  if (largest == 0.0) return value;
  float squares = 0.0, valued = 0.0;
  for (uint i = 0u; i < count; ++i) {
    if (differences[i] == kNoScaledValue) continue;
    differences[i] /= largest;
    squares += differences[i] * differences[i];
    valued += 1.0;
  }
  const float exponent = -0.5 * valued / squares;
  float weights = 0.0, sum = 0.0;
  uint ring = 0u;
  for (uint i = 0u; i < count; ++i) {
    if (i == ringEnds[ring]) ++ring;  // No ring before the last one that has faces is empty.
    if (differences[i] == kNoScaledValue) continue;
    const float ratio = 2.0 * float(ring) / float(push.window);
    const float weight = exp(exponent * differences[i] * differences[i] - 0.5 * ratio * ratio);
    weights += weight;
    sum += weight * differences[i];
  }
  return value + largest * (sum / weights);
}

void main() {
  const uint face = push.firstFace + gl_GlobalInvocationID.x;
  if (face >= push.faceCount) return;
  const float value = values[face];
  smoothed[face] = value < kNoScaledValue ? smoothedValue(face, value) : value;
}
