#include "paper/plots/line_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "paper/plots/label_places.h"
#include "paper/plots/markup.h"
#include "paper/plots/svg_canvas.h"

namespace asdfvk::bench {
namespace {

constexpr double kTextSize = 12, kTitleSize = 13.5, kNameSpacing = 16;
constexpr double kTop = 40, kLeader = 18, kSwatch = 26, kTickGap = 6;
constexpr double kTurnedDegrees = -30;
constexpr const char *kInk = "#222222", *kFaint = "#e4e4e4", *kLeaderColour = "#b5b5b5";

/// Where things go.
struct Layout {
  double left = 0, right = 0, top = kTop, bottom = 0;
  double width = 0, height = 0;  ///< Of the picture.
  bool turnsLabels = false;      ///< Of the x axis.

  [[nodiscard]] SvgPoint at(const LinePlot& plot, const PlotPoint& point) const {
    return {left + plot.x.shareOf(point.x) * (right - left), bottom - plot.y.shareOf(point.y) * (bottom - top)};
  }
};

double widestOf(const std::vector<Tick>& ticks) {
  double widest = 0;
  for (const Tick& tick : ticks) widest = std::max(widest, roughTextWidth(tick.label, kTextSize));
  return widest;
}

/// Whether labels of the x axis, upright, keep off each other.
bool fits(const LinePlot& plot, const std::vector<Tick>& ticks, double width) {
  for (size_t i = 1; i < ticks.size(); ++i) {
    const double gap = width * (plot.x.shareOf(ticks[i].value) - plot.x.shareOf(ticks[i - 1].value));
    const double needed =
        (roughTextWidth(ticks[i - 1].label, kTextSize) + roughTextWidth(ticks[i].label, kTextSize)) / 2;
    if (gap < needed + kTickGap) return false;
  }
  return true;
}

Layout layOut(const LinePlot& plot) {
  const std::vector<Tick> xTicks = axisTicks(plot.x);
  double widestName = 0;
  for (const Series& series : plot.series) widestName = std::max(widestName, roughTextWidth(series.name, kTextSize));
  Layout layout;
  layout.left = 34 + kTickGap + widestOf(axisTicks(plot.y));
  layout.right = plot.width - kLeader - kSwatch - widestName - 10;
  layout.turnsLabels = !fits(plot, xTicks, layout.right - layout.left);
  double below = 46;
  if (layout.turnsLabels) {
    const double turned = widestOf(xTicks) * std::sin(-kTurnedDegrees * M_PI / 180);
    below += turned;
    layout.left = std::max(layout.left, roughTextWidth(xTicks.front().label, kTextSize));
  }
  const double names = static_cast<double>(plot.series.size()) * kNameSpacing;
  layout.width = plot.width;
  layout.height = std::max(plot.height, kTop + names + below);
  layout.bottom = layout.height - below;
  return layout;
}

void drawAxes(SvgCanvas& canvas, const LinePlot& plot, const Layout& layout) {
  const Stroke grid{kFaint, 1, false}, frame{kInk, 1, false};
  for (const Tick& tick : axisTicks(plot.y)) {
    const double y = layout.at(plot, {plot.x.low, tick.value}).y;
    canvas.line({layout.left, y}, {layout.right, y}, grid);
    canvas.text({layout.left - kTickGap, y + kTextSize * 0.35}, tick.label, Anchor::End, kTextSize, kInk);
  }
  for (const Tick& tick : axisTicks(plot.x)) {
    const double x = layout.at(plot, {tick.value, plot.y.low}).x;
    canvas.line({x, layout.top}, {x, layout.bottom}, grid);
    canvas.line({x, layout.bottom}, {x, layout.bottom + 4}, frame);
    canvas.text({x, layout.bottom + 18}, tick.label, layout.turnsLabels ? Anchor::End : Anchor::Middle, kTextSize, kInk,
                layout.turnsLabels ? kTurnedDegrees : 0);
  }
  canvas.line({layout.left, layout.bottom}, {layout.right, layout.bottom}, frame);
  canvas.line({layout.left, layout.top}, {layout.left, layout.bottom}, frame);
  canvas.text({layout.left, kTop - 18}, plot.title, Anchor::Start, kTitleSize, kInk);
  canvas.text({(layout.left + layout.right) / 2, layout.height - 8}, plot.x.label, Anchor::Middle, kTextSize, kInk);
  canvas.text({15, (layout.top + layout.bottom) / 2}, plot.y.label, Anchor::Middle, kTextSize, kInk, -90);
}

/// The points that are drawn.
std::vector<SvgPoint> placesOf(const Series& series, const LinePlot& plot, const Layout& layout) {
  std::vector<SvgPoint> places;
  for (const PlotPoint& point : series.points)
    if (plot.x.holds(point.x) && plot.y.holds(point.y)) places.push_back(layout.at(plot, point));
  return places;
}

}  // namespace

const char* seriesColour(size_t index) {
  constexpr std::array<const char*, 7> kColours{kBlue, kVermilion, kGreen, kPurple, kOrange, kSky, kBlack};
  return kColours[index % kColours.size()];
}

std::string toSvg(const LinePlot& plot) {
  const Layout layout = layOut(plot);
  SvgCanvas canvas(layout.width, layout.height, plot.title);
  drawAxes(canvas, plot, layout);
  std::vector<std::vector<SvgPoint>> chains;
  std::vector<double> ends;
  for (const Series& series : plot.series) {
    chains.push_back(placesOf(series, plot, layout));
    ends.push_back(chains.back().empty() ? layout.bottom : chains.back().back().y);
  }
  const std::vector<double> places = placeLabels(ends, kNameSpacing, layout.top, layout.bottom);
  for (size_t i = 0; i < chains.size(); ++i) {
    const Series& series = plot.series[i];
    const Stroke stroke{series.colour, 1.8, series.isDashed};
    const double x = layout.right + kLeader;
    if (!chains[i].empty()) canvas.line(chains[i].back(), {x - 3, places[i]}, {kLeaderColour, 0.8, false});
    canvas.chain(chains[i], stroke);
    canvas.line({x, places[i]}, {x + kSwatch - 6, places[i]}, stroke);
    if (series.hasMarkers) {
      for (const SvgPoint& place : chains[i]) canvas.marker(place, series.marker, series.colour);
      canvas.marker({x + (kSwatch - 6) / 2, places[i]}, series.marker, series.colour);
    }
    canvas.text({x + kSwatch, places[i] + kTextSize * 0.35}, series.name, Anchor::Start, kTextSize, kInk);
  }
  return canvas.finished();
}

}  // namespace asdfvk::bench
