#pragma once

#include <optional>
#include <span>

#include "asdf_vk/choices.h"
#include "core/vec3.h"

namespace asdfvk {

enum class Up { X, Y, Z, MinusX, MinusY, MinusZ };

/// Names of View::up on the command line and in pages.
inline constexpr ChoiceNames<Up, 6> kUps{
    {{"x", Up::X}, {"y", Up::Y}, {"z", Up::Z}, {"-x", Up::MinusX}, {"-y", Up::MinusY}, {"-z", Up::MinusZ}}};

/// Direction of view. At azimuth 0 and elevation 0 the view is along the shorter horizontal axis of the bounding box.
struct View {
  std::optional<Up> up;          ///< Unset: the result of guessUp(), because mesh formats do not store this direction.
  double azimuthDegrees = 30;    ///< Angle of the viewer to the right, around the up direction.
  double elevationDegrees = 18;  ///< Angle of the viewer above the horizon, -90 to 90.
};

[[nodiscard]] Vec3d directionOf(Up up);

/// Stability of the points on a floor. The stability is the area of the convex hull of the lowest points, divided by
/// the area of the bounding box as seen from above. The result is negative (unstable) if the mean of the points is
/// outside of the hull.
[[nodiscard]] double standingShare(std::span<const Vec3d> points, Up up);

/// A direction in which the points are stable: `usual`, Y or Z, is tested first, then the other one of these, then the
/// others. Returns `usual` if no direction is stable. Static stability is the simplest criterion of Fu, Cohen-Or, Dror
/// and Sheffer 2008 (Upright Orientation of Man-Made Objects).
[[nodiscard]] Up guessUp(std::span<const Vec3d> points, Up usual = Up::Y);

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

/// The camera of `view` in which the points fill `area`, centred. If the points have no extent, the area spans one unit
/// of length.
[[nodiscard]] Camera frameCamera(std::span<const Vec3d> points, const View& view, const PixelArea& area);

}  // namespace asdfvk
