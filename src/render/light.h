#pragma once

#include <cstdint>

#include "render/camera.h"
#include "render/scene.h"

namespace asdfvk {

/// How much of the light reaches a point, each in [0, 1].
struct Light {
  float ambient = 1;  ///< Of the sky's hemisphere over the point.
  float key = 1;      ///< Of the key light, a disk that casts soft shadows.
};

/// The lamps go with the camera: the key light stands behind the viewer's left shoulder.
class LightRig {
 public:
  explicit LightRig(const Camera& camera);

  /// Pixels of a square of this side each cast other rays, and together they cast evenly spread ones (Keller and
  /// Heidrich 2001, Interleaved Sampling); filterLight() puts them together.
  static constexpr int kPatternSide = 5;
  static constexpr uint32_t kPatternCount = kPatternSide * kPatternSide;

  /// What one pattern's few rays say.
  [[nodiscard]] Light sample(const PictureScene& scene, const SurfacePoint& point, uint32_t pattern) const;
  /// What all patterns say.
  [[nodiscard]] Light gather(const PictureScene& scene, const SurfacePoint& point) const;

  /// Linear light towards the viewer off a dull surface of that linear colour; `normal` is unit and looks at him.
  [[nodiscard]] Vec3d shade(const Vec3d& colour, const Vec3d& normal, const Light& light) const;

 private:
  Vec3d keyDirection_, up_, toViewer_;
};

}  // namespace asdfvk
