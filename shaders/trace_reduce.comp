#version 450
// The shape diameter of one cone per lane, from the lengths of its rays (the twin of coneValue() in src/cone/cone.h).
// Lengths are compared by their bits, whose order is that of the lengths: only invalid rays are negative.
#extension GL_GOOGLE_include_directive : require
#include "shared/cone_layout.h"
#include "shared/cone_rules.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kRayCount = 30;

layout(set = 0, binding = 0, rgba32ui) uniform readonly uimageBuffer rayTexels;
layout(set = 0, binding = 1) readonly buffer Lengths { uint lengths[]; };  // Written by trace_seed.comp.
layout(set = 0, binding = 2) writeonly buffer Results { uint results[]; };
layout(push_constant) uniform Push { ConePush push; };

const uint kNotValid = 0xffffffffu;

uint lengthBits[kRayCount];

uint countBelow(uint bits) {
  uint count = 0u;
  for (uint ray = 0u; ray < kRayCount; ++ray) count += lengthBits[ray] < bits ? 1u : 0u;
  return count;
}

// Bits of the length with the given rank: the largest number with at most `rank` lengths below it.
uint findRank(uint rank) {
  uint bits = 0u;
  for (uint bit = 0x40000000u; bit != 0u; bit >>= 1)
    if (countBelow(bits | bit) <= rank) bits |= bit;
  return bits;
}

// The bits of the length of the next rank.
uint findNext(uint bits, uint rank) {
  if (countBelow(bits + 1u) > rank + 1u) return bits;
  uint next = kNotValid;
  for (uint ray = 0u; ray < kRayCount; ++ray) next = lengthBits[ray] > bits ? min(next, lengthBits[ray]) : next;
  return next;
}

float weightedMean(uint validCount, float mean) {
  const uint rank = (validCount - 1u) / 2u;
  const uint lower = findRank(rank);
  const uint upper = validCount % 2u == 0u ? findNext(lower, rank) : lower;
  const float median = 0.5 * (uintBitsToFloat(lower) + uintBitsToFloat(upper));
  float variance = 0.0;
  for (uint ray = 0u; ray < kRayCount; ++ray) {
    const float l = uintBitsToFloat(lengthBits[ray]);
    variance += lengthBits[ray] != kNotValid ? (l - mean) * (l - mean) : 0.0;
  }
  const float bound = push.outlierDeviations * sqrt(variance / float(validCount)) + kOutlierSlack * median;
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
    const bool isValid = uintBitsToFloat(bits) >= 0.0;  // kIterationLimitBits is a NaN.
    incompleteCount += isIncomplete ? 1u : 0u;
    validCount += isValid ? 1u : 0u;
    mean += isValid ? uintBitsToFloat(bits) : 0.0;
    lengthBits[ray] = isValid ? bits & 0x7fffffffu : kNotValid;  // -0 becomes 0.
  }
  uint result = kNoValueBits;
  if (validCount > 0u) result = floatBitsToUint(weightedMean(validCount, mean / float(validCount)));
  results[cone] = incompleteCount > 0u ? kIterationLimitBits : result;
}
