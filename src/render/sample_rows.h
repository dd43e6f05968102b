#pragma once

#include <cstdint>
#include <vector>

#include "render/camera.h"

namespace asdfvk {

/// A point in units of samples, x to the right, y down, depth towards the viewer.
struct Projected {
  double x = 0, y = 0, depth = 0;
};

/// A grid of samples, `perSide` by `perSide` in each pixel of the camera.
struct SampleGrid {
  const Camera& camera;
  int perSide = 1;

  [[nodiscard]] Projected project(const Vec3d& point) const {
    const Vec3d p = point - camera.centre;
    return {perSide * (camera.centreX + dot(p, camera.right) / camera.pixelSize),
            perSide * (camera.centreY - dot(p, camera.up) / camera.pixelSize), dot(p, camera.toViewer)};
  }
};

inline constexpr uint32_t kNoSample = 0xffffffff;

/// The rows of samples from `top`, below `bottom`: at each the nearest of the triangles drawn, and its depth.
class SampleRows {
 public:
  SampleRows(int width, int top, int bottom);

  void draw(uint32_t index, const Projected& a, const Projected& b, const Projected& c);

  /// The index of the triangle, or kNoSample.
  [[nodiscard]] uint32_t indexAt(int column, int row) const { return indices_[placeOf(column, row)]; }
  /// Minus infinity without a triangle.
  [[nodiscard]] float depthAt(int column, int row) const { return depths_[placeOf(column, row)]; }

 private:
  [[nodiscard]] size_t placeOf(int column, int row) const {
    return static_cast<size_t>(row - top_) * static_cast<size_t>(width_) + static_cast<size_t>(column);
  }

  int width_, top_, bottom_;
  std::vector<float> depths_;
  std::vector<uint32_t> indices_;
};

}  // namespace asdfvk
