// Reduces the lengths of the rays of one cone to its value, with all lanes of the cone (the twin of coneValue() in
// src/cone/cone.h). Needs the shared array `lengths` with the kRayCount entries of the cone from `base` on, negative
// for invalid rays; the shared array `middles`; loadRay(); `push`; and the constants kRayCount,
// kLanesPerCone and kIsCgal.
#include "shared/cone_rules.h"

float lengthAt(uint base, uint ray) { return lengths[base + ray]; }

// Each lane computes the ranks of its rays among all; the rays of the two middle ranks determine the median (the same
// ray twice for an odd count). Returns the number of valid rays and their mean.
void findMiddles(uint base, uint slot, uint lane, out uint validCount, out float mean) {
  validCount = 0u;
  mean = 0.0;
  for (uint other = 0u; other < kRayCount; ++other) {
    const float l = lengthAt(base, other);
    validCount += l >= 0.0 ? 1u : 0u;
    mean += max(l, 0.0);
  }
  mean /= float(max(validCount, 1u));
  for (uint ray = lane; ray < kRayCount; ray += kLanesPerCone) {
    const float own = lengthAt(base, ray);
    uint rank = 0u;
    for (uint other = 0u; other < kRayCount; ++other) {
      const float l = lengthAt(base, other);
      rank += l >= 0.0 && (l < own || (l == own && other < ray)) ? 1u : 0u;
    }
    if (own >= 0.0 && rank == (validCount - 1u) / 2u) middles[2u * slot] = own;
    if (own >= 0.0 && rank == validCount / 2u) middles[2u * slot + 1u] = own;
  }
}

float medianOf(uint slot) { return 0.5 * (middles[2u * slot] + middles[2u * slot + 1u]); }

// Like findMiddles(), for the absolute differences from the median.
void findMiddleDeviations(uint base, uint slot, uint lane, uint validCount, float median) {
  for (uint ray = lane; ray < kRayCount; ray += kLanesPerCone) {
    if (lengthAt(base, ray) < 0.0) continue;
    const float own = abs(lengthAt(base, ray) - median);
    uint rank = 0u;
    for (uint other = 0u; other < kRayCount; ++other) {
      const float difference = abs(lengthAt(base, other) - median);
      rank += lengthAt(base, other) >= 0.0 && (difference < own || (difference == own && other < ray)) ? 1u : 0u;
    }
    if (rank == (validCount - 1u) / 2u) middles[2u * slot] = own;
    if (rank == validCount / 2u) middles[2u * slot + 1u] = own;
  }
}

// The largest difference from the median of a length that is kept. Called after a barrier, which follows
// findMiddleDeviations() if kIsCgal.
float outlierBound(uint base, uint slot, uint validCount, float mean, float median) {
  if (kIsCgal) return push.outlierDeviations * medianOf(slot);
  float variance = 0.0;
  for (uint ray = 0u; ray < kRayCount; ++ray) {
    const float l = lengthAt(base, ray);
    variance += l >= 0.0 ? (l - mean) * (l - mean) : 0.0;
  }
  const float deviation = sqrt(variance / float(validCount));
  return push.outlierDeviations * deviation + kOutlierSlack * median;
}

// Called by one lane.
float weightedMean(uint base, uint slot, uint validCount, float mean, float median) {
  const float bound = outlierBound(base, slot, validCount, mean, median);
  float sum = 0.0;
  float weightSum = 0.0;
  for (uint ray = 0u; ray < kRayCount; ++ray) {
    const float l = lengthAt(base, ray);
    const float weight = l >= 0.0 && abs(l - median) <= bound ? loadRay(ray).weight : 0.0;
    sum += weight * l;
    weightSum += weight;
  }
  return weightSum > 0.0 ? sum / weightSum : uintBitsToFloat(kNoValueBits);
}
