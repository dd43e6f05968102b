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

/// A place that a ring and a text mark, in the unit of the mesh.
struct Callout {
  Vec3d place, opposite;  ///< Two points of the surface: the ring is around the one that is visible.
  std::string text;
};

/// The thin places of a mesh, for a picture of a grey body. Views only.
struct ThinPlaces {
  Surface surface;
  std::vector<Callout> callouts;
  std::string verdict;  ///< A word at the right end of the legend.
  bool isFailure = false;
};

/// `view` with the azimuth and the elevation, of twelve, from which the most regions are seen best: the greatest sum of
/// the square roots of their visible areas. regions: per triangle of the surface. Unchanged where nothing is visible
/// from any.
[[nodiscard]] View bestViewOf(const TraceScene& scene, Surface surface, std::span<const uint32_t> regions,
                              const View& view);

/// Width of the columns for the texts of the callouts at either side of a picture, 0 without callouts.
[[nodiscard]] double calloutWidth(std::span<const Callout> callouts, double capHeight);

/// Draws a ring at each place, and its text in the column of `columns` (left, right) that is nearer, joined by a line.
void drawCallouts(Image& image, const TraceScene& scene, const Camera& camera, std::span<const Callout> callouts,
                  const std::array<PixelArea, 2>& columns, double capHeight);

}  // namespace asdfvk
