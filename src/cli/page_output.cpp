#include "cli/page_output.h"

#include <fmt/core.h>

#include <filesystem>
#include <functional>

#include "core/text.h"
#include "page/page_contents.h"
#include "page/result_page.h"
#include "render/result_picture.h"

namespace asdfvk {
namespace {

using FieldList = std::vector<std::reference_wrapper<const Field>>;

/// The fields of --fields; without --fields, those of shownFields().
FieldList fieldsFor(const MeshOutcome& outcome) {
  const Result& result = outcome.result;
  if (outcome.outputs.fields.empty()) return shownFields(result, outcome.computation.options);
  FieldList shown;
  for (const std::string& name : outcome.outputs.fields) {
    const Field* const field = result.field(name);
    if (field == nullptr)
      throw Error(ErrorCode::UnknownField, fmt::format("--fields: the result has no field {}", name));
    shown.emplace_back(*field);
  }
  return shown;
}

}  // namespace

std::string nameInPage(const std::string& mesh) {
  return mesh == "-" ? "standard input" : std::filesystem::path(mesh).filename().string();
}

void addToPage(Page& page, const MeshOutcome& outcome, const PageMesh& mesh, const RunControl& control) {
  const FieldList fields = fieldsFor(outcome);
  const Result& result = outcome.result;
  PageTexts texts{.name = mesh.name,
                  .label = labelInPage(mesh.name, outcome.computation, result.report),
                  .report = reportTexts(result.report, mesh.showsTimes, OptionSpelling::Flag)};
  const View view = viewOf(outcome.outputs.pictureView, outcome.mesh, result, !outcome.outputs.choosesView);
  texts.picture = fallbackPicture(result, fields, view, control);
  addResult(page, std::move(texts), result, fields, view);
}

}  // namespace asdfvk
