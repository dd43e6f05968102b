#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vec3.h"
#include "render/sky_light.h"

namespace asdfvk {

/// A point of the surface. position: normalised. normal: a unit vector.
struct LitPoint {
  Vec3d position, normal;
  double light = 0;
};

/// The light at a point of each pixel of a band. On smooth surfaces, the light is computed at a few pixels of a block
/// and interpolated between them, as in the irradiance cache of Ward, Rubinstein and Clear 1988 (A Ray Tracing Solution
/// for Diffuse Interreflection). A block whose light is not nearly linear is divided.
class LightBlocks {
 public:
  /// The light must outlive this object. pixelSize: of the camera.
  LightBlocks(const SkyLight& light, int width, int height, double pixelSize);

  /// Sets the point of a pixel without its light.
  void set(int x, int y, const LitPoint& point);
  /// Computes the light at all points.
  void fill();
  /// The point of a pixel; null if none was set.
  [[nodiscard]] const LitPoint* at(int x, int y) const {
    const size_t index = indexOf(x, y);
    return states_[index] == State::Empty ? nullptr : &points_[index];
  }

 private:
  enum class State : uint8_t { Empty, Dark, Lit };

  [[nodiscard]] size_t indexOf(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }
  double lightAt(int x, int y);
  void fillBlock(int left, int top, int side);
  [[nodiscard]] bool isSmooth(int left, int top, int side) const;
  bool interpolate(int left, int top, int side);

  const SkyLight& light_;
  int width_, height_;
  double pixelSize_;
  std::vector<LitPoint> points_;
  std::vector<State> states_;
};

}  // namespace asdfvk
