#pragma once

#include <cstdint>
#include <vector>

#include "core/box3.h"
#include "core/vec3.h"

namespace asdfvk {

/// The union of the balls whose centre and radius are interpolated linearly from (a, radiusA) to (b, radiusB).
/// Precondition: neither end ball lies within the other.
struct Capsule {
  Vec3d a, b;
  double radiusA = 1, radiusB = 1;
  uint32_t part = 0;
  double blend = 0;  ///< Width of the smooth transition to the preceding capsules, a length; 0 for a sharp seam.
};

/// A smooth union of at most kMaxCapsules capsules as an implicit surface: negative inside, with Lipschitz constant 1.
/// Because of this constant, the polygoniser can skip empty space.
class CapsuleUnion {
 public:
  static constexpr size_t kMaxCapsules = 64;
  using Selection = uint64_t;
  static constexpr Selection kAll = ~Selection{0};

  explicit CapsuleUnion(std::vector<Capsule> capsules);

  struct Sample {
    double value = 0;
    Vec3d gradient;  ///< Length at most 1.
  };
  [[nodiscard]] double value(const Vec3d& p, Selection selection = kAll) const;
  [[nodiscard]] Sample sample(const Vec3d& p, Selection selection = kAll) const;

  /// The capsules that determine the surface within `radius` of p.
  [[nodiscard]] Selection near(const Vec3d& p, double radius) const;

  struct Dominating {
    uint32_t part = 0;
    double diameter = 0;  ///< Diameter of the ball of the capsule that is nearest to p.
  };
  /// Part and diameter of the capsule nearest to p. Among equally near capsules the first one counts.
  [[nodiscard]] Dominating dominating(const Vec3d& p, Selection selection = kAll) const;

  /// A box that contains the surface, blends included.
  [[nodiscard]] const Box3d& bounds() const { return bounds_; }

  [[nodiscard]] CapsuleUnion withRadiiAtLeast(double radius) const;

 private:
  struct Axis {
    Vec3d origin, direction;  ///< Unit direction from a to b.
    double length = 0;
    double radius = 0;       ///< Radius at the origin.
    double radiusSlope = 0;  ///< Change of the radius per length; above -1 and below 1.
    /// Ratio of two distances: along the axis, from the projection of a point to the centre of the ball nearest to the
    /// point; and from the point to the axis.
    double lean = 0;
    double blend = 0;
    uint32_t part = 0;
  };
  struct Nearest {
    double distance = 0;  ///< Distance to the surface of the nearest ball; negative inside.
    double radius = 0;    ///< Radius of the nearest ball.
    Vec3d fromCentre;     ///< Vector from the centre of the nearest ball to p.
    double fromCentreLength = 0;
  };
  [[nodiscard]] static Nearest nearest(const Axis& axis, const Vec3d& p);

  std::vector<Capsule> capsules_;
  std::vector<Axis> axes_;
  Selection all_ = 0;
  double largestBlend_ = 0;
  Box3d bounds_;
};

}  // namespace asdfvk
