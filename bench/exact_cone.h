#pragma once

#include <vector>

#include "cone/cone.h"

namespace asdfvk::bench {

/// A value, and how far the decisions behind it (is a ray a false intersection, is its length an outlier) are from
/// falling otherwise: there the value jumps, and a mesh that is off by more can land on the other side.
struct ExactValue {
  double value = 0;
  double cosineMargin = 0;  ///< Least |cosine| between the normals at both ends of a ray.
  double lengthMargin = 0;  ///< Least distance of a length from the bounds of what is kept, in the shape's unit.
};

/// The cone of the definition written down once more, from the directions to the weighted mean, so that exact values
/// owe nothing to what they judge but the frame of a face.
class ExactCone {
 public:
  explicit ExactCone(const ConeOptions& options);

  /// From any point of a sphere, along its normal: chords of 2 radius cos t, up to t = 45 degrees.
  [[nodiscard]] ExactValue onSphere(double radius) const;
  /// Between two parallel planes: thickness / cos t.
  [[nodiscard]] ExactValue inSlab(double thickness) const;
  /// From the point of an endless cylinder around z above or below which `barycentre` lies, in the frame of a face with
  /// that normal.
  [[nodiscard]] ExactValue inCylinder(double radius, const Vec3d& barycentre, const Vec3d& normal) const;

 private:
  /// hitOf: from a direction in the cone's frame.
  template <typename HitOf>
  [[nodiscard]] ExactValue valueOf(const HitOf& hitOf) const;

  std::vector<Vec3d> directions_;  ///< z = the axis.
  std::vector<double> weights_;
};

}  // namespace asdfvk::bench
