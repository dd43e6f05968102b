#include "cli/page_output.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "asdf_vk/choices.h"
#include "core/text.h"
#include "page/result_page.h"
#include "render/result_picture.h"

namespace asdfvk {
namespace {

using FieldList = std::vector<std::reference_wrapper<const Field>>;

/// The fields of --fields. Without --fields: all fields that a page can show, beginning with the default fields.
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

}  // namespace

std::string nameInPage(const std::string& mesh) {
  return mesh == "-" ? "standard input" : std::filesystem::path(mesh).filename().string();
}

void addToPage(Page& page, const MeshOutcome& outcome, const PageMesh& mesh, const RunControl& control) {
  const FieldList fields = shownFields(outcome);
  const Result& result = outcome.result;
  PageTexts texts{.name = mesh.name,
                  .label = labelOf(mesh.name, outcome),
                  .report = reportTexts(result.report, mesh.showsTimes, OptionSpelling::Flag)};
  const View view = viewOf(outcome.outputs.pictureView, outcome.mesh, result, !outcome.outputs.choosesView);
  addResult(page, std::move(texts), result, fields, view, control);
}

}  // namespace asdfvk
