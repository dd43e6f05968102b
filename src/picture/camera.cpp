#include "picture/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/box3.h"

namespace asdfvk {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

Vec3d axisVector(size_t axis) {
  Vec3d v;
  v[axis] = 1;
  return v;
}

/// Sets the three directions.
Camera orient(const Vec3d& boxSize, const View& view) {
  const auto upAxis = static_cast<size_t>(view.up);
  // Of the cyclic order x, y, z: with y up the front is z, with z up it is -y, as modelling programs have it.
  const size_t next = (upAxis + 1) % 3, previous = (upAxis + 2) % 3;
  const size_t firstChoice = upAxis == 2 ? previous : next, secondChoice = upAxis == 2 ? next : previous;
  const bool isTurned = boxSize[firstChoice] > boxSize[secondChoice] * 1.0001;
  const Vec3d up = axisVector(upAxis);
  Vec3d front = axisVector(isTurned ? secondChoice : firstChoice);
  if (upAxis == 2 && !isTurned) front = -front;
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
  Camera camera = orient(box.size(), view);
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
