#pragma once

#include <cstdint>
#include <vector>

#include "asdf_vk/run_control.h"
#include "render/light.h"
#include "trace/nearest_hit.h"

namespace asdfvk {

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
