#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "asdf_vk/error.h"
#include "asdf_vk/session.h"
#include "bindings.h"
#include "core/json.h"
#include "core/text.h"
#include "describe/fields.h"
#include "interruptible.h"
#include "page/page.h"
#include "page/result_page.h"
#include "pipeline/prepared_scene.h"
#include "render/png.h"
#include "render/result_picture.h"
#include "report.h"
#include "trace/scene_data.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

/// Sets label and unit of a field, if its name is the name of a result field.
void describe(Field& field) {
  for (const FieldRow& row : fieldRows())
    if (row.name == field.name && static_cast<size_t>(row.type) == field.values.index()) {
      field.label = row.label;
      field.unit = row.unit;
    }
}

/// The fields with one component; segments are first. Throws Error{OptionConflict} if there is no such field, or if a
/// field has a wrong size.
std::vector<Field> shownFields(const py::dict& perFace, uint64_t faceCount) {
  std::vector<Field> fields = fieldsOf(perFace, {});
  std::erase_if(fields, [](const Field& field) { return field.componentCount != 1; });
  if (fields.empty())
    throw Error(ErrorCode::OptionConflict, "there is nothing to show; give a field per face with one component");
  for (Field& field : fields) {
    if (field.size() != faceCount)
      throw Error(ErrorCode::OptionConflict, "the field " + field.name + " has " + std::to_string(field.size()) +
                                                 " entries, not one for each of the " + std::to_string(faceCount) +
                                                 " faces");
    if (field.reals() != nullptr) requireSingles(*field.reals(), "'" + field.name + "'");
    describe(field);
  }
  std::stable_partition(fields.begin(), fields.end(), [](const Field& field) { return field.name == "segment"; });
  return fields;
}

/// A result, together with the scene that pictures need.
Result shownResult(const MeshView& mesh, const RunControl& control) {
  StageSeconds seconds;
  StageClock clock(seconds);
  const auto prepared = std::make_shared<PreparedScene>(mesh, Orientation::Keep, clock, control);
  Result result;
  result.scene = std::make_shared<SceneData>(SceneData{prepared, prepared->view()});
  return result;
}

/// What pages and pictures show of the report of a computation.
struct ShownReport {
  ReportTexts texts;
  std::optional<ThicknessReport> thickness, gap;
  ThinSurface thinSurface;
};

/// Sets the fields and, from the report, the thin places.
void setShown(Result& result, std::vector<Field>&& fields, const std::optional<ShownReport>& report) {
  result.fields = std::move(fields);
  result.report.thickness = report ? report->thickness : std::nullopt;
  result.report.gap = report ? report->gap : std::nullopt;
  result.thinSurface = report ? report->thinSurface : ThinSurface();
}

/// field: name of the field; empty: see shownField(). report: of the result, or None.
void writePicture(const std::filesystem::path& path, const py::object& mesh, const py::dict& perFace,
                  const std::string& field, const std::optional<ShownReport>& report) {
  requireSameProcess();
  const MeshView view = viewOf(mesh);
  std::vector<Field> fields = shownFields(perFace, view.inputFaceCount());
  if (!field.empty()) (void)requireField(fields, field);
  runInterruptibly(
      [&](const RunControl& control) {
        Result result = shownResult(view, control);
        setShown(result, std::move(fields), report);
        const Field* const shown = field.empty() ? shownField(result) : result.field(field);
        writePng(path, pictureOf(result, shown, viewOf({}, "", result, shown == nullptr), {}, control));
      },
      py::none());
}

ShownReport shownReport(const Result& result) {
  return {reportTexts(result.report, true, OptionSpelling::SnakeCase), result.report.thickness, result.report.gap,
          result.thinSurface};
}

py::list summaryOf(const ShownReport& shown) {
  py::list rows;
  for (const auto& [title, text] : shown.texts.summary) rows.append(py::make_tuple(title, python::textOf(text)));
  return rows;
}

Json jsonOf(const Vec3d& p) { return {p.x, p.y, p.z}; }
Vec3d pointOf(const Json& json) { return {json[0], json[1], json[2]}; }

Json stateOf(const ThinRegion& r) {
  return {r.kind,         r.min,   r.minFace,   jsonOf(r.place), jsonOf(r.opposite), r.bodies, r.least,
          r.angleDegrees, r.width, r.faceCount, r.area,          r.areaShare};
}

ThinRegion regionOf(const Json& s) {
  return {.kind = s[0],
          .min = s[1],
          .minFace = s[2],
          .place = pointOf(s[3]),
          .opposite = pointOf(s[4]),
          .bodies = s[5],
          .least = s[6],
          .angleDegrees = s[7],
          .width = s[8],
          .faceCount = s[9],
          .area = s[10],
          .areaShare = s[11]};
}

/// What pages and pictures show of a measure that was compared with a limit; null if it was not.
Json stateOf(const std::optional<ThicknessReport>& report) {
  if (!report || !report->thinnerThan) return nullptr;
  Json least;  // NaN is no number of JSON.
  if (report->minFace)
    least = {report->min, *report->minFace, jsonOf(*report->minPlace),
             report->minOpposite ? jsonOf(*report->minOpposite) : Json()};
  Json regions = Json::array();
  for (const ThinRegion& region : report->regions) regions.push_back(stateOf(region));
  return {report->isOfGaps,    *report->thinnerThan, *report->verdict,  report->countsDetails,
          report->countsEdges, std::move(least),     std::move(regions)};
}

std::optional<ThicknessReport> thicknessOf(const Json& s) {
  if (s.is_null()) return std::nullopt;
  ThicknessReport report;
  report.isOfGaps = s[0];
  report.thinnerThan = s[1].get<double>();
  report.verdict = s[2].get<ThicknessVerdict>();
  report.countsDetails = s[3];
  report.countsEdges = s[4];
  if (!s[5].is_null()) {
    report.min = s[5][0];
    report.minFace = s[5][1].get<uint64_t>();
    report.minPlace = pointOf(s[5][2]);
    if (!s[5][3].is_null()) report.minOpposite = pointOf(s[5][3]);
  }
  for (const Json& region : s[6]) report.regions.push_back(regionOf(region));
  return report;
}

/// The report as text for pickle. Bytes that are not UTF-8 are replaced.
py::tuple stateOfShown(const ShownReport& shown) {
  const auto& [texts, thickness, gap, surface] = shown;
  const Json json = Json::array(
      {texts.summary, texts.errorSentence, texts.warnings, texts.defects, stateOf(thickness), stateOf(gap)});
  return py::make_tuple(json.dump(-1, ' ', true, Json::error_handler_t::replace), bytesOf(surface.triangles),
                        bytesOf(surface.regions));
}

ShownReport shownReportOf(const py::tuple& state) {
  ShownReport shown;
  const Json json = Json::parse(state[0].cast<std::string>());
  shown.texts = {json[0], json[1], json[2], json[3]};
  shown.thickness = thicknessOf(json[4]);
  shown.gap = thicknessOf(json[5]);
  readBytes(state[1], shown.thinSurface.triangles);
  readBytes(state[2], shown.thinSurface.regions);
  return shown;
}

/// layers: fields, label, and the ShownReport or None.
void writePage(const std::filesystem::path& path, const py::object& mesh, const std::string& name,
               const std::vector<std::tuple<py::dict, std::string, std::optional<ShownReport>>>& layers) {
  requireSameProcess();
  const MeshView view = viewOf(mesh);
  std::vector<std::vector<Field>> fieldsOfLayers;
  for (const auto& layer : layers) fieldsOfLayers.push_back(shownFields(std::get<0>(layer), view.inputFaceCount()));
  const ReportTexts noReport{.summary = {{"Mesh", counted(view.inputFaceCount(), "face")}}};
  runInterruptibly(
      [&](const RunControl& control) {
        Result result = shownResult(view, control);
        Page page = emptyPage();
        for (size_t i = 0; i < layers.size(); ++i) {
          const auto& [none, label, shown] = layers[i];
          setShown(result, std::move(fieldsOfLayers[i]), shown);
          const std::vector<std::reference_wrapper<const Field>> fields(result.fields.begin(), result.fields.end());
          const View shownView = viewOf({}, "", result, true);
          addResult(page,
                    {.name = name,
                     .label = label,
                     .report = shown ? shown->texts : noReport,
                     .picture = fallbackPicture(result, fields, shownView, control)},
                    result, fields, shownView);
        }
        asdfvk::writePage(path, page);
      },
      py::none());
}

}  // namespace

void bindShown(py::module_& module) {
  py::class_<ShownReport>(module, "ShownReport")
      .def(py::init(&shownReport))
      .def_property_readonly("summary", summaryOf)
      .def(py::pickle(&stateOfShown, &shownReportOf));
  module.def("write_picture", writePicture);
  module.def("write_page", writePage);
}

}  // namespace asdfvk::python
