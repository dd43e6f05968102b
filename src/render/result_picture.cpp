#include "render/result_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "core/text.h"
#include "describe/report_text.h"
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

/// The legend of the thin places: the sentence of the report without verdict and coordinates, for example "2 walls
/// thinner than 0.8: 0.3 (pale: behind a wall)", or "no wall thinner than 0.8; the next is 1.2".
std::string legendOf(const ThicknessReport& thickness) {
  const std::string sentence = verdictSentence(thickness, false);
  const size_t begin = std::string(verdictWord(*thickness.verdict)).size() + 2;
  return sentence.substr(begin) + (thickness.regions.empty() ? "" : " (pale: behind a wall)");
}

/// Callouts of the first kMaxCount regions. In ThicknessReport::regions, walls are first.
std::vector<Callout> calloutsOf(const ThicknessReport& thickness) {
  constexpr size_t kMaxCount = 8;
  std::vector<Callout> callouts;
  for (const ThinRegion& region : thickness.regions) {
    if (callouts.size() == kMaxCount) break;
    const std::string value = lengthText(region.min, thickness.thinnerThan);
    callouts.push_back({region.place, region.opposite,
                        region.kind == ThinKind::Wall ? value : fmt::format("{} {}", nameOf(region.kind), value)});
  }
  return callouts;
}

Image thinPictureOf(const Result& result, const View& view, const PictureStyle& style, const RunControl& control) {
  const ThicknessReport& thickness = *result.report.thickness;
  ThinPlaces places{.surface = result.thinSurface.triangles,
                    .callouts = calloutsOf(thickness),
                    .verdict = verdictWord(*thickness.verdict),
                    .isFailure = thickness.verdict != ThicknessVerdict::Passed};
  Picture picture = pictureWith(result, legendOf(thickness), view, style);
  picture.thinPlaces = std::move(places);
  return render(picture, control);
}

}  // namespace

bool comparesThickness(const Result& result) { return result.report.thickness && result.report.thickness->thinnerThan; }

const Field* shownField(const Result& result) {
  if (comparesThickness(result)) return nullptr;
  for (const char* const name : {"thickness", "segment"})
    if (const Field* const field = result.field(name)) return field;
  return &result.fields.front();
}

View viewOf(const View& requested, const std::string& input, const Result& result, bool findsThin) {
  View view = requested;
  const TraceScene& scene = result.scene->scene;
  if (!view.up) {
    const FileFormat* const format = formatOfExtension(meshExtension(input));
    view.up = format != nullptr && (format->name == "stl" || format->name == "3mf")
                  ? Up::Z
                  : guessUp(verticesOfHitFaces(scene));
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
