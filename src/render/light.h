#pragma once

#include <cstdint>
#include <vector>

#include "asdf_vk/run_control.h"
#include "render/camera.h"
#include "render/scene.h"
#include "trace/nearest_hit.h"

namespace asdfvk {

/// Visible share of each light at a point, in [0, 1].
struct Light {
  float ambient = 1;  ///< Of the sky hemisphere above the point.
  float key = 1;      ///< Of the key light, a disk that casts soft shadows.
};

/// Lights that move with the camera: the key light is behind and above the viewer, to the left.
class LightRig {
 public:
  explicit LightRig(const Camera& camera);

  /// Interleaved sampling (Keller and Heidrich 2001): the pixels of a square of this side cast different rays, together
  /// evenly distributed. filterLight() combines them.
  static constexpr int kPatternSide = 5;
  static constexpr uint32_t kPatternCount = kPatternSide * kPatternSide;

  /// Light from the few rays of one pattern.
  [[nodiscard]] Light sample(const PictureScene& scene, const SurfacePoint& point, uint32_t pattern) const;
  /// Light from the rays of all patterns.
  [[nodiscard]] Light gather(const PictureScene& scene, const SurfacePoint& point) const;

  /// Linear light reflected to the viewer by a diffuse surface of the linear colour `colour`. normal: unit, towards the
  /// viewer.
  [[nodiscard]] Vec3d shade(const Vec3d& colour, const Vec3d& normal, const Light& light) const;

 private:
  Vec3d keyDirection_, up_, toViewer_;
};

/// The surface point visible at the centre of one pixel.
struct SeenPoint {
  uint32_t face = kNoFace;  ///< kNoFace: the background.
  Vec3f position, normal;
  Light light;
};

/// Points of the whole picture, rows from the top.
struct SeenPoints {
  int width = 0, height = 0;
  double pixelSize = 0;  ///< Length that one pixel spans, in the unit of the positions.
  std::vector<SeenPoint> points;

  [[nodiscard]] const SeenPoint& at(int x, int y) const { return points[static_cast<size_t>(y * int64_t{width} + x)]; }
  [[nodiscard]] SeenPoint& at(int x, int y) { return points[static_cast<size_t>(y * int64_t{width} + x)]; }
};

/// Mean light of the points up to `radius` pixels around (x, y), weighted by the likelihood that they are on the same
/// surface as `like`. weight: the sum of the weights.
struct NearbyLight {
  Light light;
  double weight = 0;
};
[[nodiscard]] NearbyLight lightNearby(const SeenPoints& seen, int x, int y, int radius, const SeenPoint& like);

/// Replaces the light of each point by the mean over the square of patterns around it (see LightRig), then smooths it
/// once.
void filterLight(SeenPoints& seen, const RunControl& control);

}  // namespace asdfvk
