#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/camera.h"
#include "render/image.h"
#include "render/sample_rows.h"

namespace asdfvk {

/// A place to mark with a ring and a text, in the unit of the mesh.
struct Callout {
  Vec3d place, opposite;  ///< Two points of the surface. The ring is around the visible one.
  std::string text;
};

struct ThinPlaces {
  Surface surface;
  std::vector<Callout> callouts;
  std::string verdict;  ///< A word at the right end of the legend.
  bool isFailure = false;
};

/// Returns `view` with the best of twelve pairs of azimuth and elevation. Quality of a pair: sum, over the regions, of
/// the square root of the visible area. regions: region of each triangle. The view is unchanged if no pair shows a
/// region.
[[nodiscard]] View bestViewOf(const TraceScene& scene, Surface surface, std::span<const uint32_t> regions,
                              const View& view);

/// Width of the columns for the texts of the callouts at either side of a picture, in pixels; 0 without callouts.
[[nodiscard]] double calloutWidth(std::span<const Callout> callouts, double capHeight);

/// Draws a ring at each place, its text in the nearer one of the two columns (left, right), and a line between both.
void drawCallouts(Image& image, const TraceScene& scene, const Camera& camera, std::span<const Callout> callouts,
                  const std::array<PixelArea, 2>& columns, double capHeight);

}  // namespace asdfvk
