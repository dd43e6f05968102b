#version 450
// The prediction of faces from the hit points of the seeds of their cells, a face per lane. Each pass projects the
// points again, so that projections need no memory. Each lane adds in the order of its points, so that the bits are the
// same in every run. The twin of src/predict/prediction.cpp and prediction_kernel.cpp.
#extension GL_GOOGLE_include_directive : require
#include "shared/cone_hit.h"
#include "shared/cone_layout.h"
#include "shared/prediction_layout.h"
#include "shared/specialization_ids.h"

layout(local_size_x_id = kLocalSizeXId) in;
layout(constant_id = kIsCgalId) const bool kIsCgal = false;

layout(set = 0, binding = 0) readonly buffer Faces { uvec4 faceBlocks[]; };
layout(set = 0, binding = 1) readonly buffer Points { uvec4 pointBlocks[]; };
layout(set = 0, binding = 2) readonly buffer Work { uint work[]; };  // See PredictionPush.
layout(set = 0, binding = 3) buffer Values { uint values[]; };       // Per face: the bits of a length, or kNoValueBits.
layout(push_constant) uniform Push { PredictionPush push; };

const float kMinSquaredLength = 1e-37;  // Limits squared lengths, so that the inverse of the square root is finite.

uint seeds[kMaxContributingSeedCount];
float seedWeights[kMaxContributingSeedCount];  // Negative for an absent seed.

#include "approximations.glsl"

PredictionPoint loadPoint(uint index) {
  const uint block = index * kPredictionPointBlockCount;
  return decodePredictionPoint(pointBlocks[block], pointBlocks[block + 1u]);
}

PredictionPoint loadSeed(uint seed) { return loadPoint(seed * (push.rayCount + 1u)); }

// The weight of a seed is a Gaussian of its distance and of the angle between the normals. Returns the total weight.
float weighSeeds(PredictionFace at, uint cell) {
  const uint firstSeed = 2u * push.itemCount + cell * kMaxContributingSeedCount;
  float distanceSum = 0.0;
  uint count = 0u;
  const vec3 centre = loadSeed(work[firstSeed]).position;
  for (uint i = 0u; i < kMaxContributingSeedCount; ++i) {
    seeds[i] = work[firstSeed + i];
    if (seeds[i] == kNoSeed) continue;
    distanceSum += length(loadSeed(seeds[i]).position - centre);
    ++count;
  }
  const float deviation = push.distanceDeviation * distanceSum / float(2u * max(count, 2u) - 2u);
  const float inverseVariance = deviation > 0.0 ? 1.0 / (deviation * deviation) : 0.0;
  float sum = 0.0;
  for (uint i = 0u; i < kMaxContributingSeedCount; ++i) {
    seedWeights[i] = -1.0;
    if (seeds[i] == kNoSeed) continue;
    const PredictionPoint seed = loadSeed(seeds[i]);
    const vec3 offset = seed.position - at.barycentre;
    const float exponent =
        0.5 * (dot(offset, offset) * inverseVariance +
               squaredAngle(dot(seed.normal, at.normal)) / (kNormalDeviationRadians * kNormalDeviationRadians));
    seedWeights[i] = max(expNegative(min(exponent, 80.0)), kMinSeedWeight);
    sum += seedWeights[i];
  }
  return sum;
}

struct ConePoint {
  float distance;
  // The number of rays of the virtual cone that the point represents, up to a factor; 0 outside of the cone.
  float mass;
  float weight;
  bool isInlier;
};

ConePoint project(PredictionFace at, PredictionPoint point, float seedWeight) {
  const vec3 offset = point.position - at.barycentre;
  const float squared = dot(offset, offset);
  const float inverseLength = inversesqrt(max(squared, kMinSquaredLength));
  const float cosine = -dot(offset, at.normal) * inverseLength;
  const float versine = max(1.0 - cosine, push.minVersine);
  float ratio = abs(point.solidAngleRatio) * (inverseLength * inverseLength);
  // The density of rays per solid angle at this angle t to the axis is proportional to 1 / (sin t cos^2 t).
  if (kIsCgal) ratio *= inversesqrt(max(versine * (2.0 - versine), kMinSquaredLength)) / (cosine * cosine);
  const float normalCosine = kIsCgal ? -dot(point.normal, offset) : dot(point.normal, at.normal);
  const bool isInCone = cosine >= push.minCosine && normalCosine <= push.maxNormalCosine && point.face != kNoFace &&
                        point.face != at.representative;
  ConePoint seen;
  seen.distance = isInCone ? squared * inverseLength : 0.0;
  seen.mass = isInCone ? seedWeight * clamp(ratio, 1.0 / kMaxSolidAngleChange, kMaxSolidAngleChange) : 0.0;
  seen.weight = kIsCgal ? seen.mass : seen.mass * (inversesqrt(versine) * sqrtOverAngle(versine));
  seen.isInlier = point.solidAngleRatio >= 0.0;
  return seen;
}

uint firstPointOf(uint i) { return seeds[i] * (push.rayCount + 1u) + 1u; }

// End of the points of a seed; 0 for a seed that is ignored.
uint endOf(uint i, float minWeight) { return seedWeights[i] >= minWeight ? firstPointOf(i) + push.rayCount : 0u; }

// Each block of points has its own sum. Adding these sums has smaller rounding errors with many rays.
const uint kBlockSize = 64u;

// Sums over the points in the cone. Lengths are relative to the seed's median length, which reduces rounding errors.
struct ConeSums {
  float mass, difference, square;
  float weight, weightedLength;  // Sums over the inliers.
};

ConeSums plus(ConeSums a, ConeSums b) {
  return ConeSums(a.mass + b.mass, a.difference + b.difference, a.square + b.square, a.weight + b.weight,
                  a.weightedLength + b.weightedLength);
}

ConeSums sumUp(PredictionFace at, float minWeight, float medianLength) {
  ConeSums sums = ConeSums(0.0, 0.0, 0.0, 0.0, 0.0);
  for (uint i = 0u; i < kMaxContributingSeedCount; ++i) {
    const uint end = endOf(i, minWeight);
    for (uint block = firstPointOf(i); block < end; block += kBlockSize) {
      ConeSums part = ConeSums(0.0, 0.0, 0.0, 0.0, 0.0);
      for (uint k = block; k < min(block + kBlockSize, end); ++k) {
        const ConePoint seen = project(at, loadPoint(k), seedWeights[i]);
        const float difference = seen.distance - medianLength;
        const float inlierWeight = seen.isInlier ? seen.weight : 0.0;
        part = plus(part, ConeSums(seen.mass, seen.mass * difference, seen.mass * difference * difference, inlierWeight,
                                   inlierWeight * seen.distance));
      }
      sums = plus(sums, part);
    }
  }
  return sums;
}

// The median is between the lengths `low` and `high`. massToLow, massToHigh: mass of the points up to `low` and `high`.
struct MedianBounds {
  float low, high, massToLow, massToHigh;
};

// The quarter of the interval in which the mass reaches `halfMass`. ofDeviations: the median is that of the absolute
// differences of the lengths from `centre`.
MedianBounds quarterOf(PredictionFace at, float minWeight, MedianBounds bounds, float halfMass, bool ofDeviations,
                       float centre) {
  const float quarter = 0.25 * (bounds.high - bounds.low);
  const vec3 limits = bounds.low + vec3(1.0, 2.0, 3.0) * quarter;
  vec3 masses = vec3(0.0);
  for (uint i = 0u; i < kMaxContributingSeedCount; ++i) {
    const uint end = endOf(i, minWeight);
    for (uint block = firstPointOf(i); block < end; block += kBlockSize) {
      vec3 part = vec3(0.0);
      for (uint k = block; k < min(block + kBlockSize, end); ++k) {
        const ConePoint seen = project(at, loadPoint(k), seedWeights[i]);
        const float key = ofDeviations ? abs(seen.distance - centre) : seen.distance;
        part += mix(vec3(0.0), vec3(seen.mass), lessThanEqual(vec3(key), limits));
      }
      masses += part;
    }
  }
  if (masses.x >= halfMass) return MedianBounds(bounds.low, limits.x, bounds.massToLow, masses.x);
  if (masses.y >= halfMass) return MedianBounds(limits.x, limits.y, masses.x, masses.y);
  if (masses.z >= halfMass) return MedianBounds(limits.y, limits.z, masses.y, masses.z);
  return MedianBounds(limits.z, bounds.high, masses.z, bounds.massToHigh);
}

float medianBetween(PredictionFace at, float minWeight, float low, float high, float mass, uint passCount,
                    bool ofDeviations, float centre) {
  MedianBounds bounds = MedianBounds(low, high, 0.0, mass);
  for (uint pass = 0u; pass < passCount; ++pass)
    bounds = quarterOf(at, minWeight, bounds, 0.5 * mass, ofDeviations, centre);
  const float between = bounds.massToHigh - bounds.massToLow;
  const float share = between > 0.0 ? (0.5 * mass - bounds.massToLow) / between : 0.5;
  return bounds.low + share * (bounds.high - bounds.low);
}

// For the points with a length in the window: the total weight, and the sum of weight times length.
vec2 poolWithin(PredictionFace at, float minWeight, float low, float high) {
  vec2 pooled = vec2(0.0);
  for (uint i = 0u; i < kMaxContributingSeedCount; ++i) {
    const uint end = endOf(i, minWeight);
    for (uint block = firstPointOf(i); block < end; block += kBlockSize) {
      vec2 part = vec2(0.0);
      for (uint k = block; k < min(block + kBlockSize, end); ++k) {
        const ConePoint seen = project(at, loadPoint(k), seedWeights[i]);
        const float weight = low <= seen.distance && seen.distance <= high ? seen.weight : 0.0;
        part += weight * vec2(1.0, seen.distance);
      }
      pooled += part;
    }
  }
  return pooled;
}

uint predict(PredictionFace at, uint cell) {
  const float totalWeight = weighSeeds(at, cell);
  const float medianLength = loadSeed(seeds[0]).solidAngleRatio;
  float minWeight = kMinWeightShare * totalWeight;
  ConeSums sums = sumUp(at, minWeight, medianLength);
  if (!(sums.mass > 0.0)) {
    minWeight = 0.0;
    sums = sumUp(at, minWeight, medianLength);
  }
  if (!(sums.mass > 0.0)) return kNoValueBits;
  const float meanDifference = sums.difference / sums.mass;
  const float variance = sums.square / sums.mass - meanDifference * meanDifference;
  const float mean = medianLength + meanDifference;
  const float deviation = variance > 0.0 ? sqrt(variance) : 0.0;
  const float median =
      medianBetween(at, minWeight, mean - deviation, mean + deviation, sums.mass, kMedianPassCount, false, 0.0);
  float spread = deviation;
  if (kIsCgal)  // The spread is at most twice the deviation, by Chebyshev's inequality.
    spread = medianBetween(at, minWeight, 0.0, 2.0 * deviation, sums.mass, kSpreadPassCount, true, median);
  const float bound = push.outlierDeviations * spread + push.outlierSlack * median;
  const vec2 pooled = poolWithin(at, minWeight, median - bound, median + bound);
  const float weight = kPooledShare * pooled.x + (1.0 - kPooledShare) * sums.weight;
  const float sum = kPooledShare * pooled.y + (1.0 - kPooledShare) * sums.weightedLength;
  // If all lengths are almost equal, rounding can leave a deviation of almost 0, and no length is kept.
  return floatBitsToUint(weight > 0.0 ? sum / weight : mean);
}

void main() {
  const uint item = gl_GlobalInvocationID.x;
  if (item >= push.itemCount) return;
  const uint face = work[2u * item];
  const uint cell = work[2u * item + 1u];
  const uint block = face * kPredictionFaceBlockCount;
  const PredictionFace at = decodePredictionFace(faceBlocks[block], faceBlocks[block + 1u]);
  values[face] = at.normal == vec3(0.0) ? kNoValueBits : predict(at, cell);
}
