#include "render/callouts.h"

#include <algorithm>
#include <cmath>

#include "core/point2.h"
#include "render/drawing.h"
#include "render/sample_rows.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

// Lengths relative to the height of capitals.
constexpr double kRingRadius = 0.62, kRingWidth = 0.16, kLineWidth = 0.07, kRowHeight = 1.9, kCalloutGap = 0.5;
constexpr double kHidden = 1e-4;  ///< A point this far behind the first face is hidden; in normalised units.

void drawLine(Image& image, const Point2& a, const Point2& b, double width, const Rgb& colour) {
  stroke(image, {std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}, width, colour,
         [&](const Point2& p) { return distanceToSegment(p, a, b); });
}

void drawRing(Image& image, const Point2& centre, double radius, double width, const Rgb& colour) {
  stroke(image, {centre.x - radius, centre.y - radius}, {centre.x + radius, centre.y + radius}, width, colour,
         [&](const Point2& p) { return std::abs(std::hypot(p.x - centre.x, p.y - centre.y) - radius); });
}

/// Returns the pixel of the place of the callout, or of the opposite point if only that point is visible.
Point2 pixelOf(const TraceScene& scene, const Camera& camera, const Callout& callout) {
  const auto isVisible = [&](const Vec3d& point) {
    constexpr double kBeyond = 4;  // A distance above the diagonal of the normalised box, which is at most 2 sqrt(3).
    return !isHitBetween(scene.bvh, scene.mesh, point, camera.toViewer, kHidden, kBeyond);
  };
  Vec3d point = scene.bvh.normalization.toNormalized(callout.place);
  const Vec3d other = scene.bvh.normalization.toNormalized(callout.opposite);
  if (!isVisible(point) && isVisible(other)) point = other;
  const Projected projected = SampleGrid{camera}.project(point);
  return {projected.x, projected.y};
}

struct Label {
  const Callout* callout = nullptr;
  Point2 place;
  double y = 0;  ///< Middle of the text.
};

/// Sorts the labels from top to bottom, and moves the texts apart within the column.
void arrange(std::vector<Label>& labels, const PixelArea& column, double rowHeight) {
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.place.y < b.place.y; });
  double least = column.top + rowHeight / 2;
  for (Label& label : labels) {
    label.y = std::max(label.place.y, least);
    least = label.y + rowHeight;
  }
  double most = column.top + column.height - rowHeight / 2;
  for (auto label = labels.rbegin(); label != labels.rend(); ++label) {
    label->y = std::min(label->y, most);
    most = label->y - rowHeight;
  }
}

}  // namespace

double calloutWidth(std::span<const Callout> callouts, double capHeight) {
  double widest = 0;
  for (const Callout& callout : callouts) widest = std::max(widest, textWidth(callout.text, capHeight));
  return widest > 0 ? widest + 2 * kCalloutGap * capHeight : 0;
}

void drawCallouts(Image& image, const TraceScene& scene, const Camera& camera, std::span<const Callout> callouts,
                  const std::array<PixelArea, 2>& columns, double capHeight) {
  std::array<std::vector<Label>, 2> sides;
  for (const Callout& callout : callouts) {
    const Point2 place = pixelOf(scene, camera, callout);
    sides[place.x < camera.centreX ? 0 : 1].push_back({&callout, place});
  }
  const double radius = std::max(4.0, kRingRadius * capHeight), width = std::max(1.5, kRingWidth * capHeight);
  for (size_t side = 0; side < 2; ++side) {
    const PixelArea& column = columns[side];
    arrange(sides[side], column, kRowHeight * capHeight);
    for (const auto& [callout, place, y] : sides[side]) {
      const double text = textWidth(callout->text, capHeight);
      const double left = side == 0 ? column.left : column.left + column.width - text;
      const Point2 from{side == 0 ? left + text + kCalloutGap * capHeight / 2 : left - kCalloutGap * capHeight / 2, y};
      const double distance = std::hypot(place.x - from.x, place.y - from.y);
      const double share = distance > radius ? (distance - radius) / distance : 0;
      const Point2 to{from.x + (place.x - from.x) * share, from.y + (place.y - from.y) * share};
      drawLine(image, from, to, std::max(1.2, kLineWidth * capHeight), kInk);
      drawText(image, callout->text, left, y + capHeight / 2, capHeight);
      drawRing(image, place, radius, 2 * width, kWhite);
      drawRing(image, place, radius, width, kInk);
    }
  }
}

}  // namespace asdfvk
