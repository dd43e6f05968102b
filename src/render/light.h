#pragma once

#include <cstdint>

#include "render/camera.h"
#include "render/scene.h"

namespace asdfvk {

/// Share of the light that reaches a point, each in [0, 1].
struct Light {
  float ambient = 1;  ///< Of the sky's hemisphere over the point.
  float key = 1;      ///< Of the key light, a disk that casts soft shadows.
};

/// Lamps that move with the camera: the key light is behind the viewer's left shoulder.
class LightRig {
 public:
  explicit LightRig(const Camera& camera);

  /// Each pixel of a square of this side casts other rays; those of the square are spread evenly (Keller and Heidrich
  /// 2001, Interleaved Sampling). filterLight() combines them.
  static constexpr int kPatternSide = 5;
  static constexpr uint32_t kPatternCount = kPatternSide * kPatternSide;

  /// Light from the few rays of one pattern.
  [[nodiscard]] Light sample(const PictureScene& scene, const SurfacePoint& point, uint32_t pattern) const;
  /// Light from the rays of all patterns.
  [[nodiscard]] Light gather(const PictureScene& scene, const SurfacePoint& point) const;

  /// Linear light reflected to the viewer by a diffuse surface of that linear colour. normal: unit, towards the viewer.
  [[nodiscard]] Vec3d shade(const Vec3d& colour, const Vec3d& normal, const Light& light) const;

 private:
  Vec3d keyDirection_, up_, toViewer_;
};

}  // namespace asdfvk
