// Structs shared by the kernels of the prediction and the host, and the constants of the prediction. Arrays of structs
// are read as blocks of 16 bytes; floats are stored as their bits. Coordinates and lengths are normalised, see
// Normalization.
#ifndef ASDFVK_PREDICTION_LAYOUT_H
#define ASDFVK_PREDICTION_LAYOUT_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
using glsl::vec3;
#endif

// A ray represents the surface around its hit point. This surface fills one solid angle as seen from the seed, and
// another one as seen from the virtual cone. The ratio of the two angles and its inverse are limited to this factor.
// Greater ratios occur if the point is close to one origin and far from the other. In this case the surface around the
// point is not a disc.
const float kMaxSolidAngleChange = 4.0f;

// The outlier rule is applied twice: to the lengths of all seeds together (pooled), and to the lengths in the cone of
// one seed. This share of the weight of a length depends on the pooled rule, which is less noisy. The other share
// depends on the rule within the cone.
const float kPooledShare = 0.75f;

// Passes of the search for a median. Each pass reduces the interval that contains the median to a quarter; within the
// last interval, lengths are assumed to be evenly distributed. The median of the lengths is between mean - deviation
// and mean + deviation. The median of the differences (the spread) needs another pass, because its interval is wider.
const uint kMedianPassCount = 2u;
const uint kSpreadPassCount = 3u;

// Lower bound of the weight of a seed. Because of the bound, a single seed contributes at any distance.
const float kMinSeedWeight = 1e-6f;

// Standard deviation of the Gaussian weight of the angle between the normals of the seed and of the face.
const float kNormalDeviationRadians = 0.5f;

// A seed with less than this share of the total weight is ignored. The threshold adds 1 % to the error and saves a
// third of the time (bench/experiments.md).
const float kMinWeightShare = 0.08f;

// Largest number of seeds that a device uses for one face: the seed of its cell and the seeds of neighbouring cells.
const uint kMaxContributingSeedCount = 7u;

// A face, 32 bytes.
const uint kPredictionFaceBlockCount = 2u;
struct PredictionFace {
  vec3 barycentre;
  uint representative;  // The representative of its coincident faces.
  vec3 normal;          // Unit; 0 for a degenerate face.
  uint unused;
};

// A ray of every cone in the frame of the cone, 16 bytes.
struct PredictionRay {
  vec3 direction;
  float solidAngle;  // See Cone in src/cone/cone.h.
};

// A seed, 16 bytes. One array has the rays, then the seeds, then for each seed the place of its hits: a word, with four
// places in a block. The axis of its cone is the reversed face normal; the bitangent is cross(axis, tangent).
struct PredictionSeed {
  vec3 tangent;
  uint face;
};

// The hit point of a ray, 32 bytes. A seed has a PredictionPoint for itself, then one per ray. The point of the seed
// has the barycentre, face and normal of the seed. Its solidAngleRatio is the median length of the valid rays, or 0
// without valid rays.
const uint kPredictionPointBlockCount = 2u;
struct PredictionPoint {
  vec3 position;
  uint face;  // The representative that the ray hits; kNoFace for a miss.
  vec3 normal;
  // The area that the ray represents at the point, divided by the unit of Cone::solidAngles. Negative for a false hit,
  // and for an outlier in the cone of its seed.
  float solidAngleRatio;
};

struct PointPush {
  float falseHitCosine;     // See Cone in src/cone/cone.h.
  float outlierDeviations;  // Cone::outliers.
};

// One array of words has the faces that are predicted, and the cells. First, each item has a face and the index of a
// cell. Then each cell has kMaxContributingSeedCount indices of seeds.
const uint kNoSeed = 0xffffffffu;  // The index of an absent seed or cell.
struct PredictionPush {
  uint itemCount;
  uint rayCount;
  float minCosine;  // Cosine of the greatest angle between the axis and the direction to a point in the cone.
  float maxNormalCosine;
  float minVersine;  // 1 - cosine of the angle below which the weight of a point is constant.
  float outlierDeviations;
  float outlierSlack;
  float distanceDeviation;  // PredictionOptions::distanceDeviation.
};

#ifdef __cplusplus
static_assert(sizeof(PredictionFace) == 16 * kPredictionFaceBlockCount);
static_assert(sizeof(PredictionRay) == 16);
static_assert(sizeof(PredictionSeed) == 16);
static_assert(sizeof(PredictionPoint) == 16 * kPredictionPointBlockCount);
static_assert(sizeof(PointPush) == 8);
static_assert(sizeof(PredictionPush) == 32);
}  // namespace asdfvk
#else
PredictionFace decodePredictionFace(uvec4 b0, uvec4 b1) {
  return PredictionFace(uintBitsToFloat(b0.xyz), b0.w, uintBitsToFloat(b1.xyz), b1.w);
}

PredictionRay decodePredictionRay(uvec4 b0) { return PredictionRay(uintBitsToFloat(b0.xyz), uintBitsToFloat(b0.w)); }

PredictionSeed decodePredictionSeed(uvec4 b0) { return PredictionSeed(uintBitsToFloat(b0.xyz), b0.w); }

PredictionPoint decodePredictionPoint(uvec4 b0, uvec4 b1) {
  return PredictionPoint(uintBitsToFloat(b0.xyz), b0.w, uintBitsToFloat(b1.xyz), uintBitsToFloat(b1.w));
}
#endif

#endif
