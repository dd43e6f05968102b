#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "bvh/leaf_faces.h"
#include "mesh/coincident_faces.h"
#include "trace/nearest_hit.h"
#include "trace/nearest_point.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// Corners within this distance of a plane count as points of the plane. The distance is the resolution of coordinates
/// in float32.
inline constexpr double kFlat = 0x1p-22;

/// An axis-aligned box.
struct CentredBox {
  Vec3d centre, half;

  [[nodiscard]] Vec3d corner(size_t index) const {
    return centre + Vec3d{index & 1 ? half.x : -half.x, index & 2 ? half.y : -half.y, index & 4 ? half.z : -half.z};
  }
  /// The distance between p and the farthest point of the box.
  [[nodiscard]] double reachFrom(const Vec3d& p) const {
    return length(
        Vec3d{std::abs(p.x - centre.x) + half.x, std::abs(p.y - centre.y) + half.y, std::abs(p.z - centre.z) + half.z});
  }
  /// Half of the extent of the box along a direction.
  [[nodiscard]] double reachAlong(const Vec3d& direction) const {
    return std::abs(direction.x) * half.x + std::abs(direction.y) * half.y + std::abs(direction.z) * half.z;
  }
  /// The axis with the longest edges after projection along a direction of unit length or 0.
  [[nodiscard]] size_t longestAxis(const Vec3d& direction = {}) const;
};

/// A box with three axes of unit length, at right angles.
struct OrientedBox {
  std::array<Vec3d, 3> axes;
  Vec3d centre, half;

  /// False if a plane at right angles to an axis separates the box from a node, or from a triangle.
  [[nodiscard]] bool meets(const BvhNode& node) const;
  [[nodiscard]] bool meets(const PlaneTriangle& triangle) const;
};

/// The faces of one solid, in normalised coordinates.
class SolidSurface {
 public:
  /// The arguments must outlive the object.
  SolidSurface(const TraceScene& scene, const Buckets<uint32_t>& copies, std::span<const uint32_t> solidOf,
               uint32_t solid)
      : scene_(scene), copies_(copies), solidOf_(solidOf), solid_(solid) {}

  [[nodiscard]] PlaneTriangle triangle(uint32_t face) const { return triangleOf(scene_, face); }

  /// The nearest point of the solid, or any point that is less than `enough` away. atMost: see nearestSurfacePoint().
  [[nodiscard]] SurfacePoint nearest(const Vec3d& p, double enough = 0,
                                     double atMost = std::numeric_limits<double>::infinity()) const {
    return nearestSurfacePoint(
        scene_, p, enough, [&](uint32_t face) { return copyOf(face); }, atMost);
  }

  /// The first point of the solid on a ray; direction: of unit length.
  [[nodiscard]] RayHit hit(const Vec3d& origin, const Vec3d& direction) const {
    return nearestHitAmong(scene_.bvh, scene_.mesh, origin, direction,
                           [&](uint32_t face) { return copyOf(face) != kNoFace; });
  }

  /// Whether the surface covers the projection of a box into the plane of a face. contradiction: kNoFace, or a face
  /// that was found before for a larger box; receives a face that leaves the plane there.
  [[nodiscard]] bool coversPlaneBelow(const CentredBox& box, uint32_t face, uint32_t& contradiction) const;

  /// Whether no face goes through the inside of the box. May be false also if none does.
  [[nodiscard]] bool leavesEmpty(const CentredBox& box) const;

 private:
  /// The face of the solid among the copies of a primitive, or kNoFace. Touching solids may share primitives.
  [[nodiscard]] uint32_t copyOf(uint32_t primitiveFace) const {
    for (const uint32_t face : copies_[primitiveFace])
      if (solidOf_[face] == solid_) return face;
    return kNoFace;
  }

  /// Calls visit(face, triangle) for the faces that meet a box, until visit() returns false.
  template <typename Visit>
  void forEachFaceIn(const OrientedBox& box, const Visit& visit) const {
    const auto reaches = [&](const BvhNode& node) { return box.meets(node); };
    forEachLeafFace(scene_.bvh, reaches, [&](uint32_t primitiveFace) {
      const uint32_t face = copyOf(primitiveFace);
      if (face == kNoFace) return true;
      const PlaneTriangle found = triangle(face);
      return !box.meets(found) || visit(face, found);
    });
  }

  const TraceScene& scene_;
  const Buckets<uint32_t>& copies_;
  std::span<const uint32_t> solidOf_;
  uint32_t solid_;
};

}  // namespace asdfvk
