#include "render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/box3.h"
#include "core/point2.h"
#include "render/image.h"

namespace asdfvk {
namespace {

/// Points at most this far above the lowest point touch the floor. Relative to the longest side of the box.
constexpr double kFloorShare = 0.025;

/// The convex hull, counter-clockwise (Andrew's monotone chain). Fewer than three points if all points lie on a line.
std::vector<Point2> convexHull(std::vector<Point2> points) {
  std::sort(points.begin(), points.end());
  std::vector<Point2> hull;
  for (int side = 0; side < 2; ++side) {
    const size_t begin = hull.size();
    for (const Point2& point : points) {
      while (hull.size() >= begin + 2 && sideOf(hull[hull.size() - 2], hull.back(), point) <= 0) hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

Camera orient(const Vec3d& boxSize, Up upwards, const View& view) {
  const Vec3d up = directionOf(upwards);
  const size_t axis = static_cast<size_t>(upwards) % 3;
  // Modelling programs have the same rule: the front is z if y is up, and -y if z is up.
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

Vec3d directionOf(Up up) {
  const auto index = static_cast<size_t>(up);
  Vec3d direction;
  direction[index % 3] = index < 3 ? 1 : -1;
  return direction;
}

double standingShare(std::span<const Vec3d> points, Up up) {
  if (points.empty()) return 0;
  const Vec3d direction = directionOf(up);
  const size_t axis = static_cast<size_t>(up) % 3, first = (axis + 1) % 3, second = (axis + 2) % 3;
  Box3d box;
  Vec3d mean;
  double floor = dot(points[0], direction);
  for (const Vec3d& point : points) {
    box.add(point);
    mean += point / double(points.size());
    floor = std::min(floor, dot(point, direction));
  }
  const Vec3d size = box.size();
  const double reach = kFloorShare * std::max({size.x, size.y, size.z});
  std::vector<Point2> lowest;
  for (const Vec3d& point : points)
    if (dot(point, direction) <= floor + reach) lowest.push_back({point[first], point[second]});
  const std::vector<Point2> hull = convexHull(std::move(lowest));
  if (hull.size() < 3) return 0;
  double area = 0;
  bool stands = true;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    area += sideOf(hull[0], a, b) / 2;
    stands &= sideOf(a, b, {mean[first], mean[second]}) >= 0;
  }
  const double share = area / (size[first] * size[second]);
  return stands ? share : -share;
}

Up guessUp(std::span<const Vec3d> points, Up usual) {
  // Likely directions come first, because some shapes are even more stable upside down, for example a table.
  std::array<Up, 5> others{Up::Z, Up::MinusY, Up::MinusZ, Up::X, Up::MinusX};
  if (usual == Up::Z) others = {Up::Y, Up::MinusZ, Up::MinusY, Up::X, Up::MinusX};
  constexpr double kBad = 0.05, kGood = 0.2;
  if (standingShare(points, usual) > kBad) return usual;
  const auto* found =
      std::find_if(others.begin(), others.end(), [&](Up other) { return standingShare(points, other) > kGood; });
  return found == others.end() ? usual : *found;
}

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
