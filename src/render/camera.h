#pragma once

#include <span>

#include "core/vec3.h"
#include "render/view.h"

namespace asdfvk {

/// A part of the picture, in pixels from its top left corner.
struct PixelArea {
  double left = 0, top = 0, width = 0, height = 0;
};

/// A parallel projection. Pixel (x, y) is the square [x, x+1] x [y, y+1], y downwards.
struct Camera {
  Vec3d right{1, 0, 0}, up{0, 1, 0}, toViewer{0, 0, 1};  ///< Orthonormal, right-handed.
  Vec3d centre;                                          ///< The point visible at (centreX, centreY).
  double centreX = 0, centreY = 0;                       ///< In pixels.
  double pixelSize = 1;                                  ///< Length that one pixel spans.

  /// The point of the plane through `centre` at pixel position (x, y).
  [[nodiscard]] Vec3d pointAt(double x, double y) const {
    return centre + right * ((x - centreX) * pixelSize) - up * ((y - centreY) * pixelSize);
  }
};

/// The camera of `view` in which the points fill `area`, centred. Without points, or if all points coincide, the area
/// spans one unit of length.
[[nodiscard]] Camera frameCamera(std::span<const Vec3d> points, const View& view, const PixelArea& area);

}  // namespace asdfvk
