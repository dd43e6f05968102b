#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/point2.h"

namespace asdfvk {

/// Concave polygons with more corners than this are cut into a fan, which may overlap itself: ear clipping takes time
/// by the square of the corner count.
inline constexpr size_t kMaxEarClippedCorners = 1000;

/// Cuts polygons into triangles of the same winding; keeps its working memory from one polygon to the next.
class PolygonTriangulator {
 public:
  /// Fills all n - 2 `triangles` of a polygon with n >= 3 corners, none dropped where some are degenerate. A polygon
  /// with a left turn at every corner gives the fan of its first corner. Any other is cut by ear clipping (Meisters
  /// 1975) in the coordinate plane that its Newell normal is closest to, straight corners last, so that they make no
  /// empty triangles where that can be avoided. Corners that are not finite, or that span no area, give the fan.
  /// Precondition: every corner is below the vertex count.
  void triangulate(std::span<const Vec3d> vertices, std::span<const uint32_t> corners, std::span<Face> triangles);

 private:
  /// False where the polygon spans no plane.
  [[nodiscard]] bool project(std::span<const Vec3d> vertices, std::span<const uint32_t> corners);
  [[nodiscard]] double turnAt(uint32_t corner) const;
  [[nodiscard]] bool isEar(uint32_t corner) const;
  [[nodiscard]] uint32_t findEar(uint32_t start, size_t leftCount) const;
  void clipEars(std::span<const uint32_t> corners, std::span<Face> triangles);

  // Per corner of the polygon at hand; the ring of corners not yet clipped is previous_ and next_.
  std::vector<Point2> points_;
  std::vector<uint32_t> previous_, next_;
  std::vector<double> turn_;
  std::vector<uint8_t> isEar_, isClipped_;
  std::vector<uint32_t> reflex_;  ///< Corners that had no left turn at the beginning; only these can lie in an ear.
};

}  // namespace asdfvk
