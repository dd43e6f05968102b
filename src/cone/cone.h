#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "core/vec3.h"

namespace asdfvk {

/// The rays of every cone, in the frame of the cone (z = the axis). Rays are ordered by azimuth, in sectors, so that
/// each aligned group of 8 rays is a compact patch of the cone. Up to about 50 rays at 120 degrees a sector is one
/// group; with more rays the groups of a sector are ordered by the angle to the axis. directions and weights have
/// rayCount entries.
struct Cone {
  std::vector<Vec3d> directions;  ///< Unit.
  std::vector<double> weights;    ///< 1 / angle to the axis, in 1 / radians.
  double falseHitCosine = 0;      ///< A hit is false where the cosine of the angle between the normals is above this.
                                  ///< Includes the slack of shared/cone_rules.h.
  double outlierDeviations = 1;   ///< As in the options.
  double halfAngleRadians = 0;    ///< Angle between the axis and the rim.
  ConeRotation rotation = ConeRotation::Fixed;
};

/// A golden-angle (Vogel) spiral, uniform in solid angle. Throws Error{Usage} for options out of range.
[[nodiscard]] Cone makeCone(const ConeOptions& options);

/// Whether a hit is false: the normal of the hit face is within the false-hit angle of the normal of the seed face.
[[nodiscard]] inline bool isFalseHit(const Cone& cone, const Vec3d& seedNormal, const Vec3d& hitNormal) {
  return dot(seedNormal, hitNormal) > cone.falseHitCosine;
}

/// A right-handed orthonormal frame; a ray of the cone is x * tangent + y * bitangent + z * axis.
struct ConeFrame {
  Vec3d tangent, bitangent, axis;
};

/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", with the discontinuity moved to axis.z = -0.7, because
/// normals of axis-aligned walls have z = -1, 0 or 1. axis: unit, minus the normal of the face.
[[nodiscard]] ConeFrame coneFrame(const Vec3d& axis);

/// The frame of the rays of a face with the unit normal `normal`: coneFrame(-normal), turned about its axis by the
/// rotation of the cone.
[[nodiscard]] ConeFrame faceConeFrame(const Cone& cone, const Vec3d& normal, uint32_t face);

/// The range of lengths that are not outliers.
struct LengthWindow {
  double median = 0, bound = 0;
  [[nodiscard]] bool keeps(double length) const { return std::abs(length - median) <= bound; }
};

/// The median of the lengths (mean of the middle two for an even count) and the bound: outlierDeviations standard
/// deviations (population, about the mean) plus the slack kOutlierSlack of shared/cone_rules.h. Precondition: 1 to
/// kMaxRayCount lengths.
[[nodiscard]] LengthWindow keptWindow(std::span<const double> lengths, double outlierDeviations);

/// The shape diameter from the lengths of the valid rays of a cone: the weighted mean of those in keptWindow().
/// kNoValue without valid rays, and if no length is in the window, which requires outlierDeviations < 1. lengths and
/// weights have one entry per valid ray, in the order of the cone.
[[nodiscard]] double coneValue(std::span<const double> lengths, std::span<const double> weights,
                               double outlierDeviations = 1);

}  // namespace asdfvk
