#include "render/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "io/result_colours.h"
#include "render/camera.h"
#include "render/colour_bar.h"
#include "render/drawing.h"
#include "render/mesh_renderer.h"

namespace asdfvk {
namespace {

constexpr Rgb kPass{24, 122, 56};
// Relative to the height of the picture, or to 3/4 of its width if that is less.
constexpr double kCapHeightShare = 0.026, kMarginShare = 0.04;

std::vector<Rgb> faceColoursOf(const Picture& picture, const ColourRange& range) {
  std::vector<Rgb> colours(picture.scene.mesh.faceCount(), kNeutral);
  const auto opaque = [](const Rgba& colour) { return Rgb{colour[0], colour[1], colour[2]}; };
  for (size_t face = 0; face < picture.values.size(); ++face)
    colours[face] = opaque(colourOf(picture.values[face], range));
  for (size_t face = 0; face < picture.labels.size(); ++face)
    colours[face] = opaque(colourOfPart(picture.labels[face]));
  for (size_t face = 0; face < picture.highlighted.size(); ++face)
    if (picture.highlighted[face] != 0) colours[face] = kAlarm;
  return colours;
}

/// Draws the title, with a square in the alarm colour if parts are highlighted or thin. Draws the verdict at the right.
void drawLegend(Image& image, const Picture& picture, const PixelArea& area, double capHeight) {
  const bool hasSwatch = !picture.highlighted.empty() || (picture.thinPlaces && !picture.thinPlaces->surface.empty());
  const double swatch = hasSwatch ? capHeight * 1.6 : 0;
  const std::string verdict = picture.thinPlaces ? picture.thinPlaces->verdict : "";
  const double verdictWidth = textWidth(verdict, capHeight);
  const double gap = verdict.empty() ? 0 : verdictWidth + 2 * capHeight;
  const double cap = fittingCapHeight(picture.title, capHeight, area.width - swatch - gap);
  const double baseline = area.top + area.height;
  if (hasSwatch) fillRectangle(image, area.left, baseline - cap, cap, cap, kAlarm);
  drawText(image, picture.title, area.left + swatch, baseline, cap);
  if (!verdict.empty())
    drawText(image, verdict, area.left + area.width - verdictWidth, baseline, capHeight,
             picture.thinPlaces->isFailure ? kAlarm : kPass);
}

void drawMesh(Image& image, const Picture& picture, PixelArea area, const ColourRange& range, double capHeight,
              const RunControl& control) {
  const double width = picture.thinPlaces ? calloutWidth(picture.thinPlaces->callouts, capHeight) : 0;
  const std::array<PixelArea, 2> columns{
      {{area.left, area.top, width, area.height}, {area.left + area.width - width, area.top, width, area.height}}};
  area.left += width;
  area.width -= 2 * width;
  const Camera camera = frameCamera(verticesOfHitFaces(picture.scene), picture.view, area);
  renderMesh(image, picture.scene, camera, faceColoursOf(picture, range),
             picture.thinPlaces ? picture.thinPlaces->surface : Surface{}, control);
  if (!picture.thinPlaces) return;
  drawCallouts(image, picture.scene, camera, picture.thinPlaces->callouts, columns, capHeight);
}

}  // namespace

Image render(const Picture& picture, const RunControl& control) {
  ASDFVK_CHECK(kMinPictureSide <= picture.width && picture.width <= kMaxPictureSide);
  ASDFVK_CHECK(kMinPictureSide <= picture.height && picture.height <= kMaxPictureSide);
  ASDFVK_CHECK(picture.values.empty() || picture.values.size() == picture.scene.mesh.faces.size());
  ASDFVK_CHECK(picture.highlighted.empty() || picture.highlighted.size() == picture.scene.mesh.faces.size());
  ASDFVK_CHECK(picture.labels.empty() || picture.labels.size() == picture.scene.mesh.faces.size());
  control.checkpoint(0);

  Image image(picture.width, picture.height);
  const double unit = std::min<double>(picture.height, picture.width * 0.75);
  const double margin = unit * kMarginShare, capHeight = unit * kCapHeightShare * picture.textScale;
  const PixelArea inner{margin, margin, picture.width - 2 * margin, picture.height - 2 * margin};
  PixelArea area = inner;
  const ColourRange range = picture.range ? *picture.range : percentileRange(picture.values);
  const bool hasBar =
      std::any_of(picture.values.begin(), picture.values.end(), [](double v) { return !std::isnan(v); });
  if (hasBar) {
    const ColourBar bar{range, picture.title, capHeight};
    const double width = columnWidth(bar, picture.width);
    area.width -= width + margin;
    drawColourBar(image, bar, {inner.left + inner.width - width, inner.top, width, inner.height});
  } else if (!picture.title.empty()) {
    area.top += capHeight + margin;
    area.height -= capHeight + margin;
    drawLegend(image, picture, {inner.left, inner.top, inner.width, capHeight}, capHeight);
  }

  drawMesh(image, picture, area, range, capHeight, control);
  return image;
}

}  // namespace asdfvk
