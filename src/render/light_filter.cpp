#include "render/light_filter.h"

#include <algorithm>
#include <cmath>

#include "render/pixel_loop.h"

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

}  // namespace asdfvk
