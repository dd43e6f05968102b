#pragma once

#include <cstddef>
#include <cstdint>

#include "core/vec3.h"
#include "predict/point_group.h"

namespace asdfvk {

/// The cone of a face that casts no rays, in normalised units.
struct VirtualCone {
  Vec3d origin, normal;
  uint32_t face = 0;  ///< Or the one that stands for its copies: points on it do not count.
};

/// What a Cone says of all virtual cones.
struct ConeRules {
  float leastCosine = 0;     ///< Between the axis and a point in the cone.
  float greatestFacing = 0;  ///< Between the normals of the face and of a point that counts.
  float leastVersine = 0;    ///< 1 - cosine: a point nearer to the axis weighs as one there.
  float outlierDeviations = 0;
};

/// Seeds around a face, in normalised units. All arrays have one entry per seed.
struct SeedGroup {
  float x[kLaneCount] = {}, y[kLaneCount] = {}, z[kLaneCount] = {};     ///< Barycentres.
  float nx[kLaneCount] = {}, ny[kLaneCount] = {}, nz[kLaneCount] = {};  ///< Unit normals.
};

/// How much a seed counts falls with its distance and with the angle between its normal and the face's.
struct SeedReach {
  float inverseSquare = 0;  ///< 1 over the square of the distance at which a seed weighs exp(-1/2).
  float turnFactor = 0;     ///< 1 over the square of the angle, in radians, where it does so.
};

/// What a ReprojectedCone computes with; the same bits from each.
struct ConeKernel {
  struct Seen {
    const PointGroup* groups;
    const WeighedCone* cones;
    size_t coneCount;
    float typicalLength;  ///< Of the points', to a factor of a few: lengths are summed as differences to it.
    float* scratch;       ///< 3 kLaneCount floats for each group of the cones.
  };
  /// In normalised units; NaN where no point lies in the cone.
  float (*value)(const ConeRules& rules, const Seen& seen, const VirtualCone& at);
  /// weights: kLaneCount, at least kLeastSeedWeight.
  void (*weigh)(const SeedGroup& seeds, const SeedReach& reach, const VirtualCone& at, float* weights);
};

/// So that a lone seed, however far, is better than none.
inline constexpr float kLeastSeedWeight = 1e-6f;

/// A ray stands for the surface around its hit; seen from elsewhere that fills another solid angle. Where the two
/// differ by more than this factor the point is near one of them and far from the other, and that surface no disc any
/// more.
inline constexpr float kLargestSpreadChange = 4;

/// Of a length's weight: what the rules say of all lengths pooled, against what they said in the seed's own cone. The
/// first is less noisy, the second what a traced cone would have said, noise included.
inline constexpr float kPooledShare = 0.75f;

const ConeKernel& baselineConeKernel();  ///< What the program was compiled for.
const ConeKernel& avx2ConeKernel();      ///< Precondition of what follows: the machine has them.
const ConeKernel& avx512ConeKernel();

}  // namespace asdfvk
