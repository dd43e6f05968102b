#include "cli/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "asdf_vk/choices.h"
#include "asdf_vk/version.h"
#include "core/atomic_file.h"
#include "core/text.h"
#include "render/camera.h"
#include "render/png.h"
#include "render/result_picture.h"
#include "trace/scene_data.h"

namespace asdfvk {
namespace {

using FieldList = std::vector<std::reference_wrapper<const Field>>;

/// The fields of --fields; without --fields all fields that a page can show, the default fields first.
FieldList shownFields(const MeshOutcome& outcome) {
  const Result& result = outcome.result;
  FieldList shown;
  for (const std::string& name : fieldNames(outcome.outputs, outcome.computation.options)) {
    const Field* const field = result.field(name);
    if (field == nullptr && !outcome.outputs.fields.empty())
      throw Error(ErrorCode::UnknownField, fmt::format("--fields: the result has no field {}", name));
    if (field != nullptr) shown.emplace_back(*field);
  }
  if (!outcome.outputs.fields.empty()) return shown;
  for (const Field& field : result.fields) {
    const bool isShown = std::any_of(shown.begin(), shown.end(), [&](const Field& other) { return &other == &field; });
    if (field.location == FieldLocation::PerFace && field.componentCount == 1 && !isShown) shown.emplace_back(field);
  }
  std::stable_partition(shown.begin(), shown.end(), [](const Field& field) { return field.name == "segment"; });
  return shown;
}

/// Label of a mesh in the page: "cow.ply, balanced, seeds 10 %".
std::string labelOf(const std::string& name, const MeshOutcome& outcome) {
  const ComputationSettings& computation = outcome.computation;
  const Report& report = outcome.result.report;
  std::string label = fmt::format("{}, {}", name, nameOf(kRecipes, computation.recipe));
  if (computation.options.cone.definition != Definition::Paper)
    label += fmt::format(", definition {}", nameOf(kDefinitions, computation.options.cone.definition));
  if (!computation.options.measuresDiameter()) return name;
  if (report.seedCount >= report.triangleCount) return label + ", all faces";
  return label + fmt::format(", seeds {:.2g} %",
                             100.0 * static_cast<double>(report.seedCount) / static_cast<double>(report.triangleCount));
}

/// The rows of the report except the list of thin regions, with capitalised titles and continued rows joined.
/// showsTimes: if false, the rows depend on mesh and options only.
std::vector<std::pair<std::string, std::string>> summaryOf(const MeshOutcome& outcome, bool showsTimes) {
  std::vector<std::pair<std::string, std::string>> summary;
  bool isThinRow = false;
  for (auto& [title, text] : reportRows(outcome.result.report)) {
    if (!showsTimes && (title == "time" || title == "rate")) continue;
    if (!title.empty()) isThinRow = title == "thin";
    if (title.empty()) {
      if (!isThinRow) summary.back().second += "; " + text;
      continue;
    }
    title.front() = static_cast<char>(title.front() - 'a' + 'A');
    summary.emplace_back(std::move(title), std::move(text));
  }
  return summary;
}

std::string errorSentenceOf(const Result& result) {
  const Report& report = result.report;
  if (result.field("sdf") == nullptr) return "The thickness is measured at every face, so no value is interpolated.";
  if (report.seedCount >= report.triangleCount) return "Every face cast rays, so no value is interpolated.";
  if (!report.estimatedError)
    return "The values between the seeds are interpolated; their error was not estimated in this computation.";
  const ErrorEstimate& estimate = *report.estimatedError;
  return fmt::format(
      "The values between the seeds are interpolated. Compared with rays from every face they are expected to differ "
      "by {:.2f} % of the range of all values on average (standard error {:.2f} %), and by at most {:.3g} % of the "
      "value at half of the faces and {:.3g} % at 90 % of them. The estimate is from {} faces that were held out.",
      100 * estimate.average, 100 * estimate.standardError, 100 * estimate.relativeMedian,
      100 * estimate.relativePercentile90, groupDigits(estimate.heldOutCount));
}

/// The thin places; unset without a limit of the thickness.
std::optional<PageThinPlaces> thinPlacesOf(const Result& result) {
  const std::optional<ThicknessReport>& thickness = result.report.thickness;
  if (!thickness || !thickness->thinnerThan) return std::nullopt;
  return PageThinPlaces{*thickness->thinnerThan, nameOf(*thickness->verdict), thickness->regions, result.thinSurface};
}

/// The segments; empty if the page does not show the field "segment".
std::vector<PageSegment> segmentsOf(const Result& result, const FieldList& shown) {
  const Field* const field = result.field("segment");
  if (std::none_of(shown.begin(), shown.end(), [&](const Field& other) { return &other == field; })) return {};
  const TraceScene& scene = result.scene->scene;
  return listSegments(scene.mesh, scene.geometry.areas, scene.geometry.barycentres,
                      std::get<std::vector<uint32_t>>(field->values), result.sdf());
}

}  // namespace

std::string nameInPage(const std::string& mesh) {
  return mesh == "-" ? "standard input" : std::filesystem::path(mesh).filename().string();
}

Page emptyPage() { return Page(fmt::format("asdf-vk {} ({})", ASDFVK_VERSION, ASDFVK_COMMIT)); }

void addToPage(Page& page, const MeshOutcome& outcome, const PageMesh& mesh, const RunControl& control) {
  const FieldList fields = shownFields(outcome);
  PageTexts texts{.name = mesh.name, .summary = summaryOf(outcome, mesh.showsTimes)};
  texts.label = labelOf(texts.name, outcome);
  texts.errorSentence = errorSentenceOf(outcome.result);
  for (const Warning& warning : outcome.result.report.warnings)
    (warning.code == WarningCode::MeshDefect ? texts.defects : texts.warnings).push_back(textWarning(warning));
  texts.thin = thinPlacesOf(outcome.result);
  const View view =
      viewOf(outcome.outputs.pictureView, outcome.mesh, outcome.result, texts.thin && !outcome.outputs.choosesView);
  texts.up = nameOf(kUps, view.up);
  texts.azimuthDegrees = view.azimuthDegrees;
  texts.elevationDegrees = view.elevationDegrees;
  texts.segments = segmentsOf(outcome.result, fields);
  texts.picture = encodePng(texts.thin ? thinPictureOf(outcome.result, view, kPagePicture, control)
                                       : pictureOf(outcome.result, fields.front(), view, kPagePicture, control));
  page.add(outcome.result.scene->scene.mesh, fields, std::move(texts));
}

void writePage(const std::string& path, const Page& page) {
  AtomicFile file(path);
  page.write(file);
  file.commit();
}

}  // namespace asdfvk
