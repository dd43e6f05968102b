#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/box3.h"
#include "render/up_guess.h"

namespace asdfvk {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

/// Sets the three directions.
Camera orient(const Vec3d& boxSize, Up upwards, const View& view) {
  const Vec3d up = directionOf(upwards);
  const size_t axis = static_cast<size_t>(upwards) % 3;
  // Conventions of modelling programs: the front is z with y up, and -y with z up.
  const size_t usualFront = axis == 2 ? 1 : 2, otherFront = axis == 0 ? 1 : 0;
  const bool isBroadside = boxSize[otherFront] >= boxSize[usualFront];
  Vec3d front;
  front[isBroadside ? usualFront : otherFront] = isBroadside && axis == 2 ? -1 : 1;
  const Vec3d side = cross(up, front);

  const double azimuth = view.azimuthDegrees * kRadiansPerDegree;
  const double elevation = view.elevationDegrees * kRadiansPerDegree;
  const Vec3d level = front * std::cos(azimuth) + side * std::sin(azimuth);
  Camera camera;
  camera.toViewer = level * std::cos(elevation) + up * std::sin(elevation);
  camera.right = side * std::cos(azimuth) - front * std::sin(azimuth);
  camera.up = cross(camera.toViewer, camera.right);
  return camera;
}

}  // namespace

Camera frameCamera(std::span<const Vec3d> points, const View& view, const PixelArea& area) {
  Box3d box, seen;
  for (const Vec3d& point : points) box.add(point);
  Camera camera = orient(box.size(), view.up ? *view.up : guessUp(points), view);
  for (const Vec3d& point : points)
    seen.add(Vec3d{dot(point, camera.right), dot(point, camera.up), dot(point, camera.toViewer)});
  const Vec3d middle = seen.centre(), size = seen.size();
  camera.centre = camera.right * middle.x + camera.up * middle.y + camera.toViewer * middle.z;
  camera.centreX = area.left + area.width / 2;
  camera.centreY = area.top + area.height / 2;
  camera.pixelSize = std::max(size.x / area.width, size.y / area.height);
  if (!(camera.pixelSize > 0)) camera.pixelSize = 1 / std::min(area.width, area.height);
  return camera;
}

}  // namespace asdfvk
