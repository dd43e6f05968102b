#include "render/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/image.h"
#include "render/pixel_loop.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

/// Joint bilateral weight: 0 across edges, 1 on a flat surface.
double likeness(const SeenPoint& a, const SeenPoint& b, double pixelSize) {
  const double cosine = double(dot(a.normal, b.normal));
  if (cosine < 0.5) return 0;
  // A curved surface is close to its tangent plane; a surface behind it is pixels away.
  const double offPlane = std::abs(double(dot(a.normal, b.position - a.position))) / (3 * pixelSize);
  const double across = double(length(b.position - a.position)) / (12 * pixelSize);
  return std::pow(cosine, 8) * std::exp(-offPlane * offPlane - across * across);
}

constexpr uint32_t kAmbientRayCount = 4, kKeyRayCount = 2;  ///< Per pixel.
constexpr double kKeyRadius = 0.22;                         ///< Of the disk of the lamp, at distance 1.
constexpr double kAmbientReach = 0.9;  ///< Farther surfaces cast no ambient shadow; normalised unit.
constexpr double kAmbient = 0.55, kKey = 0.52, kFill = 0.08, kGroundShare = 0.66;

const double kGoldenAngle = std::numbers::pi * (3 - std::sqrt(5.0));

/// Point i of `count` evenly spread points in the unit disk (Vogel's spiral).
struct DiskPoint {
  double x, y;
};
DiskPoint diskPoint(uint32_t i, uint32_t count) {
  const double radius = std::sqrt((i + 0.5) / count), angle = i * kGoldenAngle;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Reflects directions that point into the surface.
Vec3d outOf(const Vec3d& faceNormal, const Vec3d& direction) {
  const double height = dot(faceNormal, direction);
  return height < 0 ? direction - faceNormal * (2 * height) : direction;
}

/// Index of ray `ray` of `rayCount` of a pattern among the rays of all patterns.
uint32_t placeOf(uint32_t pattern, uint32_t ray) { return pattern + LightRig::kPatternCount * ray; }

}  // namespace

NearbyLight lightNearby(const SeenPoints& seen, int x, int y, int radius, const SeenPoint& like) {
  double ambient = 0, key = 0, total = 0;
  for (int v = std::max(0, y - radius); v <= std::min(seen.height - 1, y + radius); ++v)
    for (int u = std::max(0, x - radius); u <= std::min(seen.width - 1, x + radius); ++u) {
      const SeenPoint& other = seen.at(u, v);
      if (other.face == kNoFace) continue;
      const double weight = likeness(like, other, seen.pixelSize);
      ambient += weight * double(other.light.ambient);
      key += weight * double(other.light.key);
      total += weight;
    }
  if (!(total > 0)) return {};
  return {{static_cast<float>(ambient / total), static_cast<float>(key / total)}, total};
}

void filterLight(SeenPoints& seen, const RunControl& control) {
  const int radius = LightRig::kPatternSide / 2;
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<Light> filtered(seen.points.size());
    const RunControl part = control.part(pass * 0.5, pass * 0.5 + 0.5);
    forEachPixel(seen.width, seen.height, part, [&](int x, int y) {
      const SeenPoint& own = seen.at(x, y);
      if (own.face == kNoFace) return;
      filtered[static_cast<size_t>(&own - seen.points.data())] = lightNearby(seen, x, y, radius, own).light;
    });
    for (size_t i = 0; i < filtered.size(); ++i) seen.points[i].light = filtered[i];
  }
}

LightRig::LightRig(const Camera& camera)
    : keyDirection_(unitVector(camera.toViewer * 0.75 + camera.up * 0.75 - camera.right * 0.55, camera.toViewer)),
      up_(camera.up),
      toViewer_(camera.toViewer) {}

Light LightRig::sample(const PictureScene& scene, const SurfacePoint& point, uint32_t pattern) const {
  const ConeFrame sky = RayFrame(point.lifted, point.normal).frame;
  double open = 0;
  for (uint32_t ray = 0; ray < kAmbientRayCount; ++ray) {
    // Cosine-weighted: the disk lifted onto the hemisphere.
    const DiskPoint d = diskPoint(placeOf(pattern, ray), kAmbientRayCount * kPatternCount);
    const double height = std::sqrt(std::max(0.0, 1 - d.x * d.x - d.y * d.y));
    const Vec3d direction = outOf(point.faceNormal, sky.tangent * d.x + sky.bitangent * d.y + sky.axis * height);
    open += std::min(1.0, scene.freeDistance(point.lifted, direction, point.face) / kAmbientReach);
  }
  const ConeFrame lamp = RayFrame(point.lifted, keyDirection_).frame;
  double lit = 0;
  // A surface that faces away gets no key light.
  if (dot(point.normal, keyDirection_) > 0) {
    for (uint32_t ray = 0; ray < kKeyRayCount; ++ray) {
      const DiskPoint d = diskPoint(placeOf(pattern, ray), kKeyRayCount * kPatternCount);
      const Vec3d direction =
          unitVector(lamp.axis + (lamp.tangent * d.x + lamp.bitangent * d.y) * kKeyRadius, lamp.axis);
      lit += scene.freeDistance(point.lifted, outOf(point.faceNormal, direction), point.face) < kNoHit ? 0 : 1;
    }
  }
  return {static_cast<float>(open / kAmbientRayCount), static_cast<float>(lit / kKeyRayCount)};
}

Light LightRig::gather(const PictureScene& scene, const SurfacePoint& point) const {
  Light sum{0, 0};
  for (uint32_t pattern = 0; pattern < kPatternCount; ++pattern) {
    const Light light = sample(scene, point, pattern);
    sum.ambient += light.ambient / kPatternCount;
    sum.key += light.key / kPatternCount;
  }
  return sum;
}

Vec3d LightRig::shade(const Vec3d& colour, const Vec3d& normal, const Light& light) const {
  const double hemisphere = kGroundShare + (1 - kGroundShare) * (0.5 + 0.5 * dot(normal, up_));
  const double ambient = kAmbient * hemisphere * double(light.ambient);
  const double key = kKey * std::max(0.0, dot(normal, keyDirection_)) * double(light.key);
  const double fill = kFill * std::max(0.0, dot(normal, toViewer_));
  return colour * (ambient + key + fill);
}

}  // namespace asdfvk
