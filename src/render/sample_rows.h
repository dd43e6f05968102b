#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/point2.h"
#include "render/camera.h"
#include "render/image.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// A projected point: x to the right and y down, in units of samples; depth towards the viewer, as a length.
struct Projected {
  double x = 0, y = 0, depth = 0;
};

/// A grid of samples, `perSide` by `perSide` in each pixel of the camera.
struct SampleGrid {
  Camera camera;
  int perSide = 1;

  [[nodiscard]] Projected project(const Vec3d& point) const {
    const Vec3d p = point - camera.centre;
    return {perSide * (camera.centreX + dot(p, camera.right) / camera.pixelSize),
            perSide * (camera.centreY - dot(p, camera.up) / camera.pixelSize), dot(p, camera.toViewer)};
  }
};

/// Barycentric coordinates of `place` in a triangle with an area. Outside of the triangle, some are negative.
[[nodiscard]] inline std::array<double, 3> cornerShares(const std::array<Projected, 3>& corners, const Point2& place) {
  const auto& [a, b, c] = corners;
  const auto& [x, y] = place;
  const double scale = 1 / ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  const double ofA = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) * scale;
  const double ofB = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) * scale;
  return {ofA, ofB, 1 - ofA - ofB};
}

inline constexpr uint32_t kNoSample = 0xffffffff;

/// The samples of the rows [top, bottom). For each sample, stores the nearest of the drawn triangles and the depth of
/// this triangle. Each sample has a square of its pixel. With one sample per pixel, the sample is at the centre of its
/// square. With several samples per pixel, the samples are on a rotated grid, so that all of them differ in x and in y.
/// This smooths edges that are nearly vertical or horizontal.
class SampleRows {
 public:
  SampleRows(int width, int top, int bottom, int perSide = 1);

  [[nodiscard]] Point2 placeOf(int column, int row) const {
    const double middle = (perSide_ - 1) / 2.0;
    return {column + 0.5 + (row % perSide_ - middle) / perSide_, row + 0.5 - (column % perSide_ - middle) / perSide_};
  }

  void draw(uint32_t index, const std::array<Projected, 3>& corners);

  [[nodiscard]] uint32_t indexAt(int column, int row) const { return indices_[indexOf(column, row)]; }
  /// Depth of a sample; minus infinity if the sample has no triangle.
  [[nodiscard]] float depthAt(int column, int row) const { return depths_[indexOf(column, row)]; }
  [[nodiscard]] std::vector<float> takeDepths() && { return std::move(depths_); }

 private:
  [[nodiscard]] size_t indexOf(int column, int row) const {
    return static_cast<size_t>(row - top_) * static_cast<size_t>(width_) + static_cast<size_t>(column);
  }

  int width_, top_, bottom_, perSide_;
  std::vector<float> depths_;
  std::vector<uint32_t> indices_;
};

/// Whether `surface` has a sample that is not behind that of `mesh`, up to rounding.
[[nodiscard]] inline bool isAtSurface(const SampleRows& mesh, const SampleRows& surface, int column, int row) {
  constexpr float kSlack = 1e-5F;  // In normalised units.
  return surface.indexAt(column, row) != kNoSample &&
         surface.depthAt(column, row) >= mesh.depthAt(column, row) - kSlack;
}

/// Triangles in the unit of the mesh.
using Surface = std::span<const std::array<Vec3d, 3>>;
using ProjectedSurface = std::vector<std::array<Projected, 3>>;
[[nodiscard]] ProjectedSurface projectSurface(const TraceScene& scene, const SampleGrid& grid, Surface surface);
/// Draws the triangles. Their indices are their positions in `surface`.
void drawSurface(SampleRows& rows, const ProjectedSurface& surface);

/// The vertices of the faces that rays can hit, in normalised coordinates; each vertex once.
[[nodiscard]] std::vector<Vec3d> verticesOfHitFaces(const TraceScene& scene);

class ProjectedFaces {
 public:
  /// The scene must outlive this object.
  ProjectedFaces(const TraceScene& scene, const SampleGrid& grid);

  [[nodiscard]] std::array<Projected, 3> cornersOf(uint32_t face) const {
    const auto& [a, b, c] = scene_.mesh.faces[face];
    return {vertices_[a], vertices_[b], vertices_[c]};
  }
  void drawOn(SampleRows& rows) const {
    for (const uint32_t face : scene_.bvh.primitiveFaces) rows.draw(face, cornersOf(face));
  }

 private:
  const TraceScene& scene_;
  std::vector<Projected> vertices_;
};

}  // namespace asdfvk
