#include "render/mesh_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "render/image.h"
#include "render/light.h"
#include "render/pixel_loop.h"

namespace asdfvk {
namespace {

/// A difference above this between the channels of neighbouring pixels is an edge.
constexpr int kVisibleStep = 6;
/// Additional samples of an edge pixel, on a rotated grid with one sample per row and column.
constexpr int kLookCount = 16;

class MeshRenderer {
 public:
  MeshRenderer(Image& image, const PictureScene& scene, const Camera& camera, std::span<const Rgb> faceColours)
      : image_(image), scene_(scene), camera_(camera), rig_(camera), faceColours_(faceColours) {}

  void run(const RunControl& control) {
    seen_ = {image_.width(), image_.height(), camera_.pixelSize, {}};
    seen_.points.resize(image_.pixels().size());
    forEachPixel(seen_.width, seen_.height, control.part(0, 0.7), [&](int x, int y) { look(x, y); });
    filterLight(seen_, control.part(0.7, 0.8));
    const Image behind = image_;
    forEachPixel(seen_.width, seen_.height, control.part(0.8, 0.81), [&](int x, int y) {
      const SeenPoint& point = seen_.at(x, y);
      if (point.face != kNoFace) image_.at(x, y) = toRgb(shade(point, point.light));
    });
    const Image rough = image_;
    forEachPixel(seen_.width, seen_.height, control.part(0.81, 1), [&](int x, int y) {
      if (hasStep(rough, x, y)) image_.at(x, y) = toRgb(closerLook(x, y, toLinear(behind.at(x, y))));
    });
    control.checkpoint(1);
  }

 private:
  [[nodiscard]] std::optional<SurfacePoint> trace(double x, double y) const {
    return scene_.firstOnLine(camera_.pointAt(x, y), -camera_.toViewer);
  }
  [[nodiscard]] static SeenPoint toSeen(const SurfacePoint& point) {
    return {point.face, Vec3f(point.position), Vec3f(point.normal), {}};
  }
  [[nodiscard]] Vec3d shade(const SeenPoint& point, const Light& light) const {
    return rig_.shade(toLinear(faceColours_[point.face]), Vec3d(point.normal), light);
  }

  void look(int x, int y) {
    const auto point = trace(x + 0.5, y + 0.5);
    if (!point) return;
    constexpr int kSide = LightRig::kPatternSide;
    // 7 is coprime to the number of patterns: neighbours get distant rays.
    const auto pattern = static_cast<uint32_t>(7 * (x % kSide + kSide * (y % kSide))) % LightRig::kPatternCount;
    SeenPoint seen = toSeen(*point);
    seen.light = rig_.sample(scene_, *point, pattern);
    seen_.at(x, y) = seen;
  }

  [[nodiscard]] bool hasStep(const Image& image, int x, int y) const {
    const bool isBackground = seen_.at(x, y).face == kNoFace;
    const Rgb& own = image.at(x, y);
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u) {
        if (!image.holds(u, v)) continue;
        if ((seen_.at(u, v).face == kNoFace) != isBackground) return true;
        if (isBackground) continue;
        const Rgb& other = image.at(u, v);
        for (size_t channel = 0; channel < 3; ++channel)
          if (std::abs(int{own[channel]} - int{other[channel]}) > kVisibleStep) return true;
      }
    return false;
  }

  /// The mean over the pixel, in linear light.
  [[nodiscard]] Vec3d closerLook(int x, int y, const Vec3d& behind) const {
    Vec3d sum;
    for (int i = 0; i < kLookCount; ++i) {
      const double row = (i + 0.5) / kLookCount, column = ((i * 5) % kLookCount + 0.5) / kLookCount;
      const auto point = trace(x + column, y + row);
      if (!point) {
        sum += behind;
        continue;
      }
      const SeenPoint seen = toSeen(*point);
      const NearbyLight nearby = lightNearby(seen_, x, y, 1, seen);
      sum += shade(seen, nearby.weight > 0.05 ? nearby.light : rig_.gather(scene_, *point));
    }
    return sum / double(kLookCount);
  }

  Image& image_;
  const PictureScene& scene_;
  const Camera& camera_;
  LightRig rig_;
  std::span<const Rgb> faceColours_;
  SeenPoints seen_;
};

}  // namespace

void renderMesh(Image& image, const PictureScene& scene, const Camera& camera, std::span<const Rgb> faceColours,
                const RunControl& control) {
  MeshRenderer(image, scene, camera, faceColours).run(control);
}

}  // namespace asdfvk
