#include "page/page.h"

#include <fmt/core.h>

#include <cmath>

#include "core/atomic_file.h"
#include "core/base64_stream.h"
#include "core/check.h"
#include "core/html_text.h"
#include "core/json.h"
#include "page/mesh_encoder.h"
#include "page/page_template.h"
#include "page/thin_encoder.h"

namespace asdfvk {
namespace {

Json describe(const PageThinPlaces& thin) {
  const ShownPlaces& shown = thin.shown;
  Json json{{"limit", number(shown.limit)},
            {"title", shown.title},
            {"verdict", nameOf(shown.verdict)},
            {"sentence", shown.sentence},
            {"countsDetails", shown.countsDetails},
            {"countsEdges", shown.countsEdges},
            {"regions", Json::array()}};
  for (const ThinRegion& region : shown.regions)
    json["regions"].push_back({{"face", region.minFace},
                               {"value", number(region.min)},
                               {"least", number(region.least)},
                               {"angleDegrees", number(region.angleDegrees)},
                               {"width", number(region.width)},
                               {"area", number(region.area)},
                               {"areaShare", number(region.areaShare)},
                               {"faceCount", region.faceCount},
                               {"kind", nameOf(region.kind)},
                               {"bodies", region.bodies},
                               {"change", region.change ? Json(nameOf(*region.change)) : Json(nullptr)},
                               {"place", arrayOf(region.place)},
                               {"opposite", arrayOf(region.opposite)}});
  for (const SealedVoid& each : shown.voids)  // After the regions, to whose places the thin surface refers.
    json["regions"].push_back({{"face", each.face},
                               {"value", number(each.volume)},
                               {"area", number(std::pow(std::cbrt(each.volume), 2))},  // About that of a section.
                               {"kind", "void"},
                               {"bodies", each.looseBodies},
                               {"place", arrayOf(each.place)},
                               {"opposite", arrayOf(each.place)}});
  return json;
}

Json describe(const PageTexts& texts) {
  Json json{{"name", texts.name}, {"label", texts.label}, {"up", texts.up}};
  json["view"] = {texts.azimuthDegrees, texts.elevationDegrees};
  json["summary"] = Json::array();
  for (const auto& [title, value] : texts.report.summary)
    json["summary"].push_back({{"title", title}, {"value", value}});
  json["errorSentence"] = texts.report.errorSentence;
  json["warnings"] = texts.report.warnings;
  json["defects"] = texts.report.defects;
  if (const std::optional<LeastPlace>& least = texts.least)
    json["least"] = {{"kind", least->kind},
                     {"value", number(least->value)},
                     {"face", least->face},
                     {"place", arrayOf(least->place)},
                     {"opposite", arrayOf(least->opposite)}};
  json["segments"] = Json::array();
  for (const PageSegment& segment : texts.segments)
    json["segments"].push_back({{"label", segment.label},
                                {"faceCount", segment.faceCount},
                                {"area", number(segment.area)},
                                {"median", number(segment.median)},
                                {"centre", arrayOf(segment.centre)}});
  return json;
}

}  // namespace

void Page::add(const TriangleMesh& mesh, FieldSpan fields, PageTexts texts) {
  Json description = describe(texts);
  const Box3d box = boxOfFaces(mesh);
  description.update(encodeMesh(mesh, fields, arrays_, box));
  if (texts.thin) {
    description["thin"] = describe(*texts.thin);
    if (!texts.thin->surface.triangles.empty())
      description["thin"]["surface"] = encodeThinSurface(texts.thin->surface, box, arrays_);
    texts.thin.reset();  // The thin places are already encoded in `description`.
  }
  meshes_.push_back(std::make_shared<const Json>(std::move(description)));
  texts_.push_back(std::move(texts));
}

void Page::write(AtomicFile& file) const {
  using Part = void (Page::*)(AtomicFile&) const;
  constexpr std::pair<std::string_view, Part> kPlaces[]{{"@TITLE@", &Page::writeTitle},
                                                        {"@DATA@", &Page::writeData},
                                                        {"@FALLBACK@", &Page::writeFallback},
                                                        {"@SCRIPT@", &Page::writeScript}};
  std::string_view rest = kPageTemplate;
  for (;;) {
    size_t at = std::string_view::npos;
    std::pair<std::string_view, Part> place;
    for (const auto& candidate : kPlaces)
      if (const size_t found = rest.find(candidate.first); found < at) {
        at = found;
        place = candidate;
      }
    file.write(rest.substr(0, at));
    if (at == std::string_view::npos) return;
    (this->*place.second)(file);
    rest.remove_prefix(at + place.first.size());
  }
}

void Page::writeTitle(AtomicFile& file) const {
  std::string title;
  for (const PageTexts& texts : texts_) {
    constexpr size_t kMaxTitleSize = 200;
    if (title.size() > kMaxTitleSize) {
      title += ", ...";
      break;
    }
    title += (title.empty() ? "" : ", ") + texts.label;
  }
  file.write(escapedForHtml(title));
}

Json Page::data() const {
  Json meshes = Json::array();
  for (const auto& mesh : meshes_) meshes.push_back(*mesh);
  return {{"generator", generator_}, {"meshes", std::move(meshes)}};
}

void Page::writeData(AtomicFile& file) const {
  file.write("<script type=\"application/json\" id=\"asdf-vk-page\">");
  file.write(escapedForScript(data().dump(-1, ' ', true, Json::error_handler_t::replace)));
  file.write("</script>\n");
  arrays_.write(file);
}

void Page::writeFallback(AtomicFile& file) const {
  for (const PageTexts& texts : texts_) {
    if (texts.picture.empty()) continue;
    const std::string label = escapedForHtml(texts.label);
    file.write(fmt::format("<figure><img alt=\"{0}\" src=\"data:image/png;base64,", label));
    Base64Stream base64(file);
    base64.write({reinterpret_cast<const uint8_t*>(texts.picture.data()), texts.picture.size()});
    base64.finish();
    file.write(fmt::format("\"><figcaption>{}</figcaption></figure>\n", label));
  }
}

void Page::writeScript(AtomicFile& file) const {
  Base64Stream base64(file);
  base64.write(deflated(Bytes(kPageScript.begin(), kPageScript.end())));
  base64.finish();
}

}  // namespace asdfvk
