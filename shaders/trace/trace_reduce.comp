#version 450
// The shape diameter of one cone per lane, from the lengths of its rays: the twin of coneValue() in
// src/cone/cone_value.h. Lengths are compared by their bits. Bits and lengths have the same order, because only invalid
// rays are negative.
#extension GL_GOOGLE_include_directive : require
#include "shared/cone_layout.h"
#include "shared/cone_rules.h"
#include "shared/specialization_ids.h"

layout(local_size_x_id = kLocalSizeXId) in;
layout(constant_id = kRayCountId) const uint kRayCount = 30;
layout(constant_id = kIsCgalId) const bool kIsCgal = false;

layout(set = 0, binding = 0, rgba32ui) uniform readonly uimageBuffer rayTexels;
layout(set = 0, binding = 1) readonly buffer Lengths { uint lengths[]; };  // Written by trace_main.glsl.
layout(set = 0, binding = 2) writeonly buffer Results { uint results[]; };
layout(push_constant) uniform Push { ConePush push; };

const uint kNotValid = 0xffffffffu;
const uint kInfinityBits = 0x7f800000u;

uint lengthBits[kRayCount];

uint deviationBits(uint ray, float centre) {
  if (lengthBits[ray] == kNotValid) return kNotValid;
  return floatBitsToUint(abs(uintBitsToFloat(lengthBits[ray]) - centre));
}

// The mean of the middle two differences from `centre`; with the centre 0, the median of the lengths. Each pass
// determines two bits, which halves the iterations of a bisection.
float medianDifference(uint validCount, float centre) {
  const uint rank = (validCount - 1u) / 2u;
  uint bits = 0u;
  for (int shift = 30; shift >= 0; shift -= 2) {
    const uvec3 limits = bits | uvec3(1u, 2u, 3u) << uint(shift);
    uvec3 counts = uvec3(0u);
    for (uint ray = 0u; ray < kRayCount; ++ray) counts += uvec3(lessThan(uvec3(deviationBits(ray, centre)), limits));
    bits = counts.z <= rank ? limits.z : counts.y <= rank ? limits.y : counts.x <= rank ? limits.x : bits;
  }
  uint upToCount = 0u;
  uint next = kNotValid;
  for (uint ray = 0u; ray < kRayCount; ++ray) {
    const uint own = deviationBits(ray, centre);
    upToCount += own <= bits ? 1u : 0u;
    next = own > bits ? min(next, own) : next;
  }
  const uint upper = validCount % 2u == 0u && upToCount == rank + 1u ? next : bits;
  return 0.5 * (uintBitsToFloat(bits) + uintBitsToFloat(upper));
}

float outlierBound(uint validCount, float mean, float median) {
  if (kIsCgal) return push.outlierDeviations * medianDifference(validCount, median);
  float variance = 0.0;
  for (uint ray = 0u; ray < kRayCount; ++ray) {
    const float l = uintBitsToFloat(lengthBits[ray]);
    variance += lengthBits[ray] != kNotValid ? (l - mean) * (l - mean) : 0.0;
  }
  return push.outlierDeviations * sqrt(variance / float(validCount)) + kOutlierSlack * median;
}

float weightedMean(uint validCount, float mean) {
  const float median = medianDifference(validCount, 0.0);
  const float bound = outlierBound(validCount, mean, median);
  float sum = 0.0;
  float weightSum = 0.0;
  for (uint ray = 0u; ray < kRayCount; ++ray) {
    const float l = lengthBits[ray] != kNotValid ? uintBitsToFloat(lengthBits[ray]) : -1.0;
    const float weight =
        l >= 0.0 && abs(l - median) <= bound ? decodeConeRay(imageLoad(rayTexels, int(ray))).weight : 0.0;
    sum += weight * l;
    weightSum += weight;
  }
  return weightSum > 0.0 ? sum / weightSum : uintBitsToFloat(kNoValueBits);
}

void main() {
  const uint cone = gl_GlobalInvocationID.x;
  if (cone >= push.coneCount) return;
  uint validCount = 0u;
  uint incompleteCount = 0u;
  float mean = 0.0;
  for (uint ray = 0u; ray < kRayCount; ++ray) {
    const uint bits = lengths[ray * push.coneCount + cone];
    const bool isIncomplete = bits == kIterationLimitBits;
    // Tests the bits, because a device may assume that there are no NaNs such as kIterationLimitBits.
    const bool isValid = bits <= kInfinityBits || bits == 0x80000000u;
    incompleteCount += isIncomplete ? 1u : 0u;
    validCount += isValid ? 1u : 0u;
    mean += isValid ? uintBitsToFloat(bits) : 0.0;
    lengthBits[ray] = isValid ? bits & 0x7fffffffu : kNotValid;  // -0 becomes 0.
  }
  uint result = kNoValueBits;
  if (validCount > 0u) result = floatBitsToUint(weightedMean(validCount, mean / float(validCount)));
  results[cone] = incompleteCount > 0u ? kIterationLimitBits : result;
}
