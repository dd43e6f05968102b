#pragma once

#include <vector>

#include "asdf_vk/run_control.h"
#include "render/camera.h"
#include "render/sample_rows.h"

namespace asdfvk {

/// Light of a sky and of a lamp, with soft shadows from a depth map per direction of light (Williams 1978, Casting
/// Curved Shadows on Curved Surfaces). Both move with the camera: the lamp is behind and above the viewer, to the left.
class SkyLight {
 public:
  /// pictureSide: the longer one, in pixels. Precondition: the scene has a face that rays can hit. Throws
  /// Error{Cancelled}.
  SkyLight(const TraceScene& scene, const Camera& camera, int pictureSide, const RunControl& control);

  /// Linear light that a white diffuse surface reflects to the viewer at a point in normalised coordinates. normal:
  /// unit, towards the viewer.
  [[nodiscard]] double at(const Vec3d& point, const Vec3d& normal) const;

 private:
  /// A direction of light, as a camera that looks along it.
  struct Source {
    SampleGrid grid;
    double radiance = 0;
    double reach = 0;           ///< A shadow fades behind the surface that casts it, and ends at this distance from it.
    std::vector<float> depths;  ///< Depths of the surface that is nearest to the light.
  };

  /// 1 where the point is not behind the surface; behind it from 0 to 1, see reach. Bilinear between the texels.
  [[nodiscard]] double litShare(const Source& source, const Vec3d& point) const;

  Vec3d toViewer_;
  int mapSide_;  ///< In texels.
  double texelSize_ = 0;
  std::vector<Source> sources_;
};

}  // namespace asdfvk
