#pragma once

#include <vector>

#include "cone/cone.h"

namespace asdfvk::bench {

/// The cone of the definition, ray by ray in the order of the spiral, written down here once more so that the exact
/// values owe nothing to makeCone(). Rays whose hit looks along the seed's normal are dropped, as the definition says.
class ExactCone {
 public:
  explicit ExactCone(const ConeOptions& options);

  /// From any point of a sphere, along its normal: chords of 2 radius cos t, up to t = 45 degrees.
  [[nodiscard]] double onSphere(double radius) const;
  /// Between two parallel planes: thickness / cos t.
  [[nodiscard]] double inSlab(double thickness) const;
  /// From the point of an endless cylinder around z above or below which `barycentre` lies, in the frame of a face with
  /// that normal.
  [[nodiscard]] double inCylinder(double radius, const Vec3d& barycentre, const Vec3d& normal) const;

 private:
  /// hitOf: from a direction in the cone's frame.
  template <typename HitOf>
  [[nodiscard]] double valueOf(const HitOf& hitOf) const;

  std::vector<Vec3d> directions_;  ///< In the cone's frame, z = the axis.
  std::vector<double> weights_;
};

}  // namespace asdfvk::bench
