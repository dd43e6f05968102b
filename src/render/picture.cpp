#include "render/picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/camera.h"
#include "render/colour_bar.h"
#include "render/draft_renderer.h"
#include "render/drawing.h"
#include "render/label_colours.h"
#include "render/mesh_renderer.h"
#include "render/scene.h"

namespace asdfvk {
namespace {

constexpr Rgb kNeutral{210, 209, 204}, kHighlight{206, 38, 30};
// Divided by the height of the picture.
constexpr double kCapHeightShare = 0.026, kMarginShare = 0.04;

std::vector<Rgb> faceColoursOf(const Picture& picture, const ColourRange& range) {
  if (!picture.labels.empty()) return labelColours(picture.scene.mesh, picture.scene.geometry.areas, picture.labels);
  std::vector<Rgb> colours(picture.scene.mesh.faceCount(), kNeutral);
  for (size_t face = 0; face < picture.values.size(); ++face) {
    const Rgba colour = colourOf(picture.values[face], range);
    colours[face] = {colour[0], colour[1], colour[2]};
  }
  for (size_t face = 0; face < picture.highlighted.size(); ++face)
    if (picture.highlighted[face] != 0) colours[face] = kHighlight;
  return colours;
}

/// A square in the colour of the highlight, and the title.
void drawLegend(Image& image, const Picture& picture, const PixelArea& area, double capHeight) {
  const double swatch = picture.highlighted.empty() ? 0 : capHeight * 1.6;
  const double cap = fittingCapHeight(picture.title, capHeight, area.width - swatch);
  const double baseline = area.top + area.height;
  if (swatch > 0) fillRectangle(image, area.left, baseline - cap, cap, cap, kHighlight);
  drawText(image, picture.title, area.left + swatch, baseline, cap);
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

  if (picture.isDraft) {
    const Camera camera = frameCamera(verticesOfHitFaces(picture.scene), picture.view, area);
    renderDraft(image, picture.scene, camera, faceColoursOf(picture, range));
    return image;
  }
  const PictureScene scene(picture.scene);
  const Camera camera = frameCamera(scene.points(), picture.view, area);
  renderMesh(image, scene, camera, faceColoursOf(picture, range), control);
  return image;
}

}  // namespace asdfvk
