#pragma once

#include <array>
#include <cstdint>
#include <limits>
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

/// A rectangle of samples, in units of samples, and the depth of its nearest point.
struct SampleBox {
  double left = 0, top = 0, right = 0, bottom = 0, nearest = 0;
};

/// The samples of the rows [top, bottom). For each sample, stores the nearest of the drawn triangles and the depth of
/// this triangle. Triangles behind the samples of whole tiles cost little, so the nearest triangles should be drawn
/// first. Each sample has a square of its pixel. With one sample per pixel, the sample is at the centre of its
/// square. With several samples per pixel, the samples are on a rotated grid, so that all of them differ in x and in y.
/// This smooths edges that are nearly vertical or horizontal.
class SampleRows {
 public:
  /// perSide: a power of two. keepsIndices: if false, only depths are stored.
  SampleRows(int width, int top, int bottom, int perSide = 1, bool keepsIndices = true);

  [[nodiscard]] Point2 placeOf(int column, int row) const {
    const double middle = (perSide_ - 1) / 2.0;
    return {column + 0.5 + (row % perSide_ - middle) / perSide_, row + 0.5 - (column % perSide_ - middle) / perSide_};
  }

  void draw(uint32_t index, const std::array<Projected, 3>& corners);

  /// Whether the box is outside of the rows, or behind all their samples. May be false for a box that is hidden.
  [[nodiscard]] bool hides(const SampleBox& box);

  [[nodiscard]] uint32_t indexAt(int column, int row) const { return indices_[indexOf(column, row)]; }
  /// Depth of a sample; minus infinity if the sample has no triangle.
  [[nodiscard]] float depthAt(int column, int row) const { return depths_[indexOf(column, row)]; }
  [[nodiscard]] std::vector<float> takeDepths() && { return std::move(depths_); }

 private:
  [[nodiscard]] size_t indexOf(int column, int row) const {
    return static_cast<size_t>(row - top_) * static_cast<size_t>(width_) + static_cast<size_t>(column);
  }

  /// The depth of the farthest sample, or a lower bound of it after `writeCount` changes of samples.
  struct Tile {
    float farthest = -kInfinity;
    int writeCount = 0;
  };
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  /// Depth as a function of the column, within the depths of a triangle.
  struct DepthLine {
    double atZero, perColumn, farthest, nearest;
  };

  [[nodiscard]] bool isHidden(int tileColumn, int tileRow, float nearest);
  /// Draws every perSide_-th sample of the columns from first to second. Returns the number of changed samples.
  int drawRow(uint32_t index, int row, std::pair<int, int> columns, const DepthLine& line);
  [[nodiscard]] size_t tileAt(int tileColumn, int tileRow) const {
    return static_cast<size_t>(tileRow) * static_cast<size_t>(tileColumns_) + static_cast<size_t>(tileColumn);
  }

  int width_, top_, bottom_, perSide_, tileColumns_;
  std::vector<float> depths_;
  std::vector<uint32_t> indices_;
  std::vector<Tile> tiles_;
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
  /// Draws the faces, roughly the nearest first, and leaves out those in hidden nodes of the hierarchy.
  void drawOn(SampleRows& rows) const;

 private:
  [[nodiscard]] SampleBox boxOf(const BvhNode& node) const;

  const TraceScene& scene_;
  SampleGrid grid_;
  std::vector<Projected> vertices_;
};

}  // namespace asdfvk
