#include "render/sky_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cone/cone.h"
#include "core/parallel.h"
#include "core/vec3.h"
#include "render/image.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

constexpr double kLampRadius = 0.22;  ///< Radius of the disk of the lamp, at distance 1.
constexpr double kSky = 0.58, kLamp = 0.55, kFill = 0.08;
constexpr double kGroundShare = 0.66;  ///< Radiance of the lowest direction, divided by the radiance of the highest.
constexpr double kSkyReach = 0.9;      ///< Surfaces farther away cast no shadow of the sky. In normalised units.
/// Numbers of directions of light. Very many faces reduce the number, because each depth map draws all faces.
constexpr int kMinSkyCount = 16, kMaxSkyCount = 96, kSkyPerLamp = 4;
/// Limit on the number of faces drawn into all depth maps of the sky, divided by the side of a map in texels.
constexpr size_t kFacesPerTexel = 48'000;
constexpr double kMaxDepth = 65500;  ///< Greatest number of Source::depths, less a margin for rounding.
constexpr int kMaxMapSide = 512;     ///< Greatest side of a depth map, in texels.
/// Distance in texels by which points are lifted from their surface, so that no plane shadows itself. The distance is
/// above sqrt(2), because a point is compared with texels at distances of up to sqrt(2).
constexpr double kLift = 1.6;

const double kGoldenAngle = std::numbers::pi * (3 - std::sqrt(5.0));

/// Point i on a Vogel spiral. The points are evenly distributed over a disk if the squared radii are uniform.
Vec3d spiralPoint(int i, double radius, double height) {
  return {radius * std::cos(i * kGoldenAngle), radius * std::sin(i * kGoldenAngle), height};
}

}  // namespace

SkyLight::SkyLight(const TraceScene& scene, const Camera& camera, int pictureSide, const RunControl& control)
    : toViewer_(camera.toViewer), mapSide_(std::clamp(pictureSide / 2, 32, kMaxMapSide)) {
  const BvhNode& root = scene.bvh.nodes[0];
  const Box3d box{Vec3d(root.min), Vec3d(root.max)};
  texelSize_ = box.diagonal() / (mapSide_ - 6);
  leastDepth_ = -box.diagonal() / 2;
  depthStep_ = box.diagonal() / kMaxDepth;
  const auto addSource = [&](const Vec3d& direction, double radiance, double reach) {
    const ConeFrame frame = coneFrame(direction);
    const Camera view{.right = frame.tangent,
                      .up = frame.bitangent,
                      .toViewer = direction,
                      .centre = box.centre(),
                      .centreX = mapSide_ / 2.0,
                      .centreY = mapSide_ / 2.0,
                      .pixelSize = texelSize_};
    sources_.push_back({{view, 1}, radiance, reach, {}});
  };
  const size_t affordable = kFacesPerTexel * static_cast<size_t>(mapSide_) / scene.bvh.primitiveFaces.size();
  const int skyCount = static_cast<int>(std::clamp<size_t>(affordable, kMinSkyCount, kMaxSkyCount));
  const int lampCount = skyCount / kSkyPerLamp;
  for (int i = 0; i < skyCount; ++i) {
    const double height = 1 - 2 * (i + 0.5) / skyCount;
    const Vec3d d = spiralPoint(i, std::sqrt(1 - height * height), height);
    // The mean of max(0, cosine) over the sphere is 1/4. With the factor 4, radiance 1 gives a white surface light 1.
    addSource(camera.right * d.x + camera.toViewer * d.y + camera.up * d.z,
              kSky * 4 / skyCount * (kGroundShare + (1 - kGroundShare) * (0.5 + 0.5 * height)), kSkyReach);
  }
  const ConeFrame lamp =
      coneFrame(unitVector(camera.toViewer * 0.75 + camera.up * 0.75 - camera.right * 0.55, camera.toViewer));
  for (int i = 0; i < lampCount; ++i) {
    const Vec3d d = lamp.toWorld(spiralPoint(i, kLampRadius * std::sqrt((i + 0.5) / lampCount), 1));
    addSource(d / length(d), kLamp / lampCount, kNoHit);
  }

  constexpr size_t kMapsAtOnce = 8;  // Maps between two checkpoints.
  for (size_t begin = 0; begin < sources_.size(); begin += kMapsAtOnce) {
    control.checkpoint(static_cast<double>(begin) / static_cast<double>(sources_.size()));
    forEachTask(std::min(kMapsAtOnce, sources_.size() - begin), [&](size_t i) {
      Source& source = sources_[begin + i];
      SampleRows map(mapSide_, 0, mapSide_, 1, false);
      ProjectedFaces(scene, source.grid).drawOn(map);
      const std::vector<float> depths = std::move(map).takeDepths();
      source.depths.resize(depths.size());
      const auto scale = static_cast<float>(1 / depthStep_), offset = static_cast<float>(1 - leastDepth_ / depthStep_);
      for (size_t texel = 0; texel < depths.size(); ++texel)
        source.depths[texel] = static_cast<uint16_t>(static_cast<int>(std::max(0.0F, depths[texel] * scale + offset)));
    });
  }
}

double SkyLight::litShare(const Source& source, const Vec3d& point) const {
  const Projected p = source.grid.project(point);
  const double left = std::floor(p.x - 0.5), top = std::floor(p.y - 0.5);
  const auto column = static_cast<size_t>(left), row = static_cast<size_t>(top);
  const double depth = p.depth - leastDepth_ + depthStep_;
  const auto shareAt = [&](size_t x, size_t y) {
    const double before = source.depths[y * static_cast<size_t>(mapSide_) + x] * depthStep_ - depth;
    return before <= 0 ? 1.0 : std::min(1.0, before / source.reach);
  };
  const double x = p.x - 0.5 - left, y = p.y - 0.5 - top;
  return (1 - y) * ((1 - x) * shareAt(column, row) + x * shareAt(column + 1, row)) +
         y * ((1 - x) * shareAt(column, row + 1) + x * shareAt(column + 1, row + 1));
}

double SkyLight::at(const Vec3d& point, const Vec3d& normal) const {
  const Vec3d lifted = point + normal * (kLift * texelSize_);
  double light = kFill * std::max(0.0, dot(normal, toViewer_));
  for (const Source& source : sources_) {
    const double cosine = dot(normal, source.grid.camera.toViewer);
    if (cosine > 0) light += source.radiance * cosine * litShare(source, lifted);
  }
  return light;
}

}  // namespace asdfvk
