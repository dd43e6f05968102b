#include "web/page_session.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "asdf_vk/choices.h"
#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "core/atomic_file.h"
#include "core/json.h"
#include "describe/computation_options.h"
#include "describe/default_fields.h"
#include "describe/option_json.h"
#include "describe/option_rules.h"
#include "describe/report_json.h"
#include "describe/report_text.h"
#include "page/page_contents.h"
#include "page/result_page.h"
#include "render/result_picture.h"
#include "web/joined_results.h"
#include "web/mesh_limit.h"

namespace asdfvk {
namespace {

ComputationSettings settingsOf(const Json& options) {
  SettingsWithRows all;
  complete(all.computation, setOptions({&all.ofComputation, 1}, options));
  return all.computation;
}

SessionSettings sessionSettings() {
  SessionSettings settings;
  settings.backend = BackendChoice::Cpu;
  return settings;
}

}  // namespace

/// The results refer to the scene, and the scene to the mesh.
struct PageSession::Opened {
  Opened(Session& session, std::string givenName, Mesh givenMesh, const RunControl& control)
      : name(std::move(givenName)), mesh(std::move(givenMesh)), scene(session, mesh, Orientation::Keep, control) {}

  std::string name;
  Mesh mesh;
  Scene scene;
  Json ofCheck = Json::object(), ofComputation = Json::object();  ///< Options.
  std::optional<Result> checked, computed;

  [[nodiscard]] bool hasResult() const { return checked || computed; }

  /// The settings with which the program computes both results at once.
  [[nodiscard]] ComputationSettings settings() const {
    Json options = ofCheck;
    options.update(ofComputation);
    if (checked && computed)
      options["measure"] =
          nameOf(kMeasures, united(settingsOf(ofCheck).options.measure, settingsOf(ofComputation).options.measure));
    return settingsOf(options);
  }

  [[nodiscard]] Result result() const {
    if (!hasResult()) throw Error(ErrorCode::InvalidArgument, "there is no result yet; check or compute first");
    if (!computed) return *checked;
    return checked ? joined(*checked, *computed) : *computed;
  }
};

PageSession::PageSession() : settings_(sessionSettings()), session_(settings_) {}
PageSession::~PageSession() = default;

PageSession::Opened& PageSession::opened() const {
  if (!opened_) throw Error(ErrorCode::InvalidArgument, "there is no mesh; open a file first");
  return *opened_;
}

Json PageSession::open(const std::filesystem::path& file, const std::optional<std::string>& unit,
                       const RunControl& control) {
  opened_.reset();  // Its memory is needed.
  Mesh mesh = readMesh(file);
  requireMemory(mesh, file.filename().string());
  if (unit) mesh.unit = *unit;
  opened_ = std::make_unique<Opened>(session_, file.filename().string(), std::move(mesh), control);
  const Mesh& read = opened_->mesh;
  return {{"name", opened_->name},
          {"faceCount", read.inputFaceCount()},
          {"triangleCount", read.faces.size()},
          {"vertexCount", read.vertices.size()},
          {"unit", read.unit},
          {"skipped", read.skipped}};
}

Result PageSession::measure(const Json& options, const RunControl& control) {
  ComputationSettings settings = settingsOf(options);
  settings.options.keepsScene = true;
  return opened().scene.compute(CheckedOptions(settings.options), {}, control);
}

void PageSession::check(const Json& options, const RunControl& control) {
  opened().checked = measure(options, control);
  opened_->ofCheck = options;
}

void PageSession::compute(const Json& options, const RunControl& control) {
  opened().computed = measure(options, control);
  opened_->ofComputation = options;
}

Json PageSession::report() const {
  const Opened& mesh = opened();
  const Result result = mesh.result();
  Report report = result.report;
  for (Warning& warning : report.warnings) warning.message = textWarning(warning, OptionSpelling::Flag);
  Json json{{"mesh", mesh.name}};
  json.update(resultJson(report, result.fields, mesh.settings(), settings_));
  return json;
}

Page PageSession::page() const {
  const Opened& mesh = opened();
  const Result result = mesh.result();
  const ComputationSettings settings = mesh.settings();
  Page page = emptyPage();
  PageTexts texts{.name = mesh.name,
                  .label = labelInPage(mesh.name, settings, result.report),
                  .report = reportTexts(result.report, true, OptionSpelling::Flag)};
  addResult(page, std::move(texts), result, shownFields(result, settings.options), viewOf({}, mesh.name, result, true));
  return page;
}

void PageSession::save(const std::filesystem::path& file) const {
  const Opened& mesh = opened();
  const std::string extension = file.extension().string();
  if (extension == ".html") return writePage(file, page());
  if (extension == ".json") {
    AtomicFiles files;
    files.write(file, [&](AtomicFile& output) { output.write(jsonText(report(), 2) + "\n"); });
    return files.commit();
  }
  writeResult(file, mesh.mesh, mesh.result().fields, {.fields = defaultFieldNames(mesh.settings().options)});
}

}  // namespace asdfvk
