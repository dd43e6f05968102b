#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/mesh.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// The hit of a picture ray. Normals are unit and point against the ray.
struct SurfacePoint {
  uint32_t face = 0;
  Vec3d position;
  Vec3d lifted;      ///< `position` moved to the smooth surface of `normal`; origin of further rays.
  Vec3d faceNormal;  ///< Of the flat face.
  Vec3d normal;      ///< Interpolated between the corners, see cornerNormals().
};

/// The first hit on the infinite line through `point` along the unit `direction`, in normalised coordinates.
struct LineHit {
  uint32_t face = 0;
  Vec3d position;
};
[[nodiscard]] std::optional<LineHit> firstOnLine(const TraceScene& scene, const Vec3d& point, const Vec3d& direction);

/// A mesh prepared for picture rays. Coordinates are normalised (see Normalization).
class PictureScene {
 public:
  /// The scene must outlive this object.
  explicit PictureScene(const TraceScene& scene);

  /// The finite vertices of the faces that rays can hit, some of them more than once.
  [[nodiscard]] std::vector<Vec3d> points() const;

  /// See asdfvk::firstOnLine().
  [[nodiscard]] std::optional<SurfacePoint> firstOnLine(const Vec3d& point, const Vec3d& direction) const;

  /// Distance from origin, which lies in the mesh's box or near it, to the nearest face other than `skippedFace`;
  /// infinite for a miss.
  [[nodiscard]] double freeDistance(const Vec3d& origin, const Vec3d& direction, uint32_t skippedFace) const;

 private:
  [[nodiscard]] SurfacePoint describe(uint32_t face, const Vec3d& position, const Vec3d& direction) const;

  const TraceScene& scene_;
  std::vector<std::array<Vec3d, 3>> cornerNormals_;
};

}  // namespace asdfvk
