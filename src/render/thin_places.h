#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/callouts.h"
#include "render/camera.h"
#include "render/sample_rows.h"

namespace asdfvk {

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

}  // namespace asdfvk
