#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "core/simd.h"
#include "core/vec3.h"
#include "shared/cone_rules.h"

namespace asdfvk {

/// A length is an outlier if it differs from the median by more than `deviations` times the spread (plus a slack).
struct OutlierRule {
  enum class Spread {
    StandardDeviation,  ///< Population standard deviation about the mean.
    MedianDeviation,    ///< Median of the absolute differences from the median.
  };

  Spread spread = Spread::StandardDeviation;
  double deviations = 1;                              ///< Largest difference from the median, in units of the spread.
  double slack = static_cast<double>(kOutlierSlack);  ///< Added to the largest difference, in units of the median.
};

/// The rays that all cones have, and the rules for their hits. These data define the shape diameter. Rays are in the
/// frame of the cone (z = the axis). Rays are ordered by azimuth, in sectors, so that each aligned group of 8 rays is a
/// compact patch of the cone. With up to about 50 rays at 120 degrees, a sector has one group. With more rays, a sector
/// has several groups, ordered by the angle to the axis. directions, weights and solidAngles have rayCount entries.
struct Cone {
  Definition definition = Definition::Paper;  ///< Selects the frame and the vector that falseHitCosine refers to.
  std::vector<Vec3d> directions;              ///< Unit vectors.
  std::vector<double> weights;                ///< Paper: 1 / angle to the axis, in 1 / radians. Cgal: 1.
  std::vector<double> solidAngles;  ///< Solid angle that each ray represents, up to a common factor; Paper: 1.
  double falseHitCosine = 0;        ///< See isFalseHit(); includes the slack of shared/cone_rules.h.
  OutlierRule outliers;
  double halfAngleRadians = 0;  ///< Angle between the axis and the rim.
  /// A ray ignores faces within this distance of its origin, in normalised units: kContactDistance, or more for cones
  /// with grazing rays. See also kOuterSideFactor.
  double contactDistance = 0;
  ConeRotation rotation = ConeRotation::Fixed;
};

/// Paper: a golden-angle (Vogel) spiral, uniform in solid angle. Cgal: the spiral of CGAL's disk, uniform in the
/// tangent of the angle to the axis. Precondition: 1 to kMaxRayCount rays.
[[nodiscard]] Cone makeCone(const ConeOptions& options);

/// Whether a hit is false. Paper: the normals of hit face and seed face differ by less than the false-hit angle. Cgal:
/// the angle between the ray and the normal of the hit face is not acute. Vectors may also be those of lane_vec3.h; the
/// result is then a mask.
template <typename SeedVector = Vec3d, typename Vector = Vec3d>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline auto isFalseHit(const Cone& cone, const SeedVector& seedNormal,
                                                          const Vector& direction, const Vector& hitNormal) {
  const auto cosine = cone.definition == Definition::Paper ? dot(hitNormal, seedNormal) : -dot(direction, hitNormal);
  return cosine > cone.falseHitCosine;
}

/// A right-handed orthonormal frame; a ray of the cone is x * tangent + y * bitangent + z * axis.
struct ConeFrame {
  Vec3d tangent, bitangent, axis;

  [[nodiscard]] Vec3d toWorld(const Vec3d& ray) const { return ray.x * tangent + ray.y * bitangent + ray.z * axis; }
};

/// Whether coneFrame() uses the first of its two cases.
[[nodiscard]] inline bool isConeFrameFlipped(const Vec3d& axis) { return axis.z < -0.7; }

/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", with the discontinuity moved to axis.z = -0.7, because
/// normals of axis-aligned walls have z = -1, 0 or 1. axis: unit, minus the normal of the face.
[[nodiscard]] ConeFrame coneFrame(const Vec3d& axis);

/// CGAL's frame. inward: of any length above 0. The tangent depends on which coordinates of `inward` are exactly 0.
[[nodiscard]] ConeFrame cgalConeFrame(const Vec3d& inward);

/// Rotation by which paperConeFrame() turns the frame about its axis, in radians, 0 to 2 pi.
[[nodiscard]] double coneRotation(const Cone& cone, uint64_t key);

/// The frame of the rays at a unit normal in Definition::Paper: coneFrame(-normal), turned about its axis by
/// coneRotation(). key: the number that ConeRotation::Hashed hashes; for a face its index.
[[nodiscard]] ConeFrame paperConeFrame(const Cone& cone, const Vec3d& normal, uint64_t key);

}  // namespace asdfvk
