#pragma once

#include <string>
#include <vector>

#include "paper/plots/axis.h"

namespace asdfvk::bench {

struct PlotPoint {
  double x = 0, y = 0;
};

/// The colours of Okabe and Ito 2008 (Color Universal Design) that stand out on white; told apart by any eye.
inline constexpr const char *kBlue = "#0072B2", *kVermilion = "#D55E00", *kGreen = "#009E73", *kPurple = "#B4548C",
                            *kOrange = "#E69F00", *kSky = "#56B4E9", *kBlack = "#222222";
/// One after the other, repeating.
[[nodiscard]] const char* seriesColour(size_t index);

/// Points joined in their order and named at the right end. Points that an axis does not hold are left out.
struct Series {
  std::string name;
  std::vector<PlotPoint> points;
  const char* colour = kBlack;
  size_t marker = 0;  ///< As SvgCanvas::marker().
  bool isDashed = false;
  bool hasMarkers = true;
};

struct LinePlot {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  double width = 560, height = 400;  ///< Of the whole picture; grows in height where the series' names need it.
};

/// An SVG document: axes with round ticks, a fine grid, and each series' name, marker and line at the right side, level
/// with its last point as far as names do not overlap.
[[nodiscard]] std::string toSvg(const LinePlot& plot);

}  // namespace asdfvk::bench
