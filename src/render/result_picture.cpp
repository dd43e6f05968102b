#include "render/result_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "core/text.h"
#include "describe/report_text.h"
#include "describe/shown_places.h"
#include "io/formats.h"
#include "render/picture.h"
#include "trace/scene_data.h"

namespace asdfvk {
namespace {

template <typename T>
std::vector<T> onTriangles(const TriangleMesh& mesh, const std::vector<T>& ofInputFaces) {
  if (mesh.polygons.isEmpty()) return ofInputFaces;
  std::vector<T> result;
  result.reserve(mesh.faces.size());
  for (const uint32_t inputFace : mesh.polygons.inputFaceOf) result.push_back(ofInputFaces[inputFace]);
  return result;
}

Picture pictureWith(const Result& result, std::string title, const View& view, const PictureStyle& style) {
  Picture picture{.scene = result.scene->scene, .title = std::move(title), .view = view};
  picture.width = style.width;
  picture.height = style.height;
  picture.textScale = style.textScale;
  return picture;
}

/// Callouts of the first kMaxCount regions and voids. In ShownPlaces::regions, walls are first.
std::vector<Callout> calloutsOf(const ShownPlaces& shown) {
  constexpr size_t kMaxCount = 8;
  std::vector<Callout> callouts;
  for (const ThinRegion& region : shown.regions) {
    if (callouts.size() == kMaxCount) break;
    const std::string change = region.change ? fmt::format("{} ", nameOf(*region.change)) : "";
    const std::string kind = region.kind == ThinKind::Wall ? "" : fmt::format("{} ", nameOf(region.kind));
    callouts.push_back({region.place, region.opposite, change + kind + lengthText(region.min, shown.limit)});
  }
  for (const SealedVoid& each : shown.voids)
    if (callouts.size() < kMaxCount)
      callouts.push_back({each.place, each.place, fmt::format("void, volume {}", lengthText(each.volume))});
  return callouts;
}

Image thinPictureOf(const Result& result, const View& view, const PictureStyle& style, const RunControl& control) {
  const ShownPlaces shown = *shownPlaces(result.report);
  ThinPlaces places{.surface = result.thinSurface.triangles,
                    .callouts = calloutsOf(shown),
                    .verdict = verdictWord(shown.verdict),
                    .isFailure = shown.verdict != ThicknessVerdict::Passed};
  Picture picture =
      pictureWith(result, shown.legend + (shown.regions.empty() ? "" : " (pale: behind a wall)"), view, style);
  picture.thinPlaces = std::move(places);
  return render(picture, control);
}

}  // namespace

bool comparesThickness(const Result& result) { return shownPlaces(result.report).has_value(); }

const Field* shownField(const Result& result) {
  if (comparesThickness(result)) return nullptr;
  for (const char* const name : {"thickness", "gap", "segment"})
    if (const Field* const field = result.field(name)) return field;
  return &result.fields.front();
}

View viewOf(const View& requested, const std::string& input, const Result& result, bool findsThin) {
  View view = requested;
  const TraceScene& scene = result.scene->scene;
  if (!view.up) {
    const FileFormat* const format = formatOfExtension(meshExtension(input));
    const std::string_view name = format != nullptr ? format->name : "";
    const bool isOfPrinters = name == "stl" || name == "3mf",
               isOfModels = name == "glb" || name == "obj" || name == "off";
    view.up = isOfPrinters ? Up::Z : guessUp(verticesOfHitFaces(scene), isOfModels ? Up::Y : Up::Z);
  }
  const ThinSurface& surface = result.thinSurface;
  return findsThin && comparesThickness(result) ? bestViewOf(scene, surface.triangles, surface.regions, view) : view;
}

Image pictureOf(const Result& result, const Field* shown, const View& view, const PictureStyle& style,
                const RunControl& control) {
  if (shown == nullptr) return thinPictureOf(result, view, style, control);
  const Field& field = *shown;
  const TriangleMesh& mesh = result.scene->scene.mesh;
  Picture picture = pictureWith(result, field.label, view, style);
  std::vector<double> values;
  std::vector<uint8_t> flags;
  std::vector<uint32_t> labels;
  if (const std::vector<double>* reals = field.reals()) {
    values = onTriangles(mesh, *reals);
    picture.values = values;
  } else if (const auto* marks = std::get_if<std::vector<uint8_t>>(&field.values)) {
    flags = onTriangles(mesh, *marks);
    picture.highlighted = flags;
  } else if (const auto* indices = std::get_if<std::vector<uint32_t>>(&field.values)) {
    labels = onTriangles(mesh, *indices);
    picture.labels = labels;
  }
  return render(picture, control);
}

}  // namespace asdfvk
