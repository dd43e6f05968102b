#pragma once

#include <cstdint>

#include "render/camera.h"
#include "render/scene.h"

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

}  // namespace asdfvk
