#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "asdf_vk/run_control.h"
#include "io/colour_map.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/thin_places.h"
#include "trace/trace_scene.h"

namespace asdfvk {

inline constexpr int kMinPictureSide = 64, kMaxPictureSide = 8192;

/// What render() draws. Holds views of its arrays.
struct Picture {
  const TraceScene& scene;
  /// #F: values, in the colours of colourOf() with a colour bar; NaN is grey. Empty: light grey faces, no bar.
  std::span<const double> values;
  std::span<const uint8_t> highlighted;  ///< #F: 1 for a face in the alarm colour; may be empty.
  std::span<const uint32_t> labels;      ///< #F: parts, in the colours of colourOfPart(); may be empty.
  std::optional<ThinPlaces> thinPlaces;  ///< Drawn on a grey body; the title is the legend.
  std::string title;                     ///< Above the bar; if there is no bar, above the mesh.
  std::optional<ColourRange> range;      ///< Range of the bar; unset: percentileRange() of the values.
  int width = 1200, height = 900;        ///< In pixels, kMinPictureSide to kMaxPictureSide.
  View view;
  double textScale = 1;  ///< Factor on title and labels; above 1 for pictures that are printed small.
};

/// Renders on the CPU with depth buffers: parallel projection, white background, soft light. The result has the same
/// bits for any number of threads. If no face has an area, only the background is drawn. Precondition: every index of a
/// face is below the vertex count. Throws Error{Cancelled}.
[[nodiscard]] Image render(const Picture& picture, const RunControl& control = {});

}  // namespace asdfvk
