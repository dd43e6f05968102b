#pragma once

#include <vector>

#include "asdf_vk/run_control.h"
#include "render/camera.h"
#include "render/sample_rows.h"

namespace asdfvk {

/// Light of a sky and of a lamp, with soft shadows from a depth map per direction of light (Williams 1978, Casting
/// Curved Shadows on Curved Surfaces). The sky and the lamp move with the camera; the lamp is behind the viewer, above
/// and to the left.
class SkyLight {
 public:
  /// pictureSide: longer side in pixels. Precondition: the scene has a face that rays can hit. Throws Error{Cancelled}.
  SkyLight(const TraceScene& scene, const Camera& camera, int pictureSide, const RunControl& control);

  /// Linear light that a white diffuse surface reflects to the viewer. point: normalised. normal: a unit vector.
  [[nodiscard]] double at(const Vec3d& point, const Vec3d& normal) const;

 private:
  /// A direction of light, as a camera that looks along it.
  struct Source {
    SampleGrid grid;
    double radiance = 0;
    double reach = 0;              ///< The shadow of a surface fades over this distance and ends there.
    std::vector<uint16_t> depths;  ///< For each texel, the depth of the surface that is nearest to the light.
  };

  /// Share of the light that reaches the point, interpolated bilinearly between texels. The share is below 1 if the
  /// surface of the depth map is in front of the point by less than `reach`. In all other cases the share is 1.
  [[nodiscard]] double litShare(const Source& source, const Vec3d& point) const;

  Vec3d toViewer_;
  int mapSide_;  ///< In texels.
  double texelSize_ = 0;
  double depthStep_ = 0, leastDepth_ = 0;  ///< Unit of Source::depths, and the depth of the number 1; 0 is no surface.
  std::vector<Source> sources_;
};

}  // namespace asdfvk
