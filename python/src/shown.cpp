#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "asdf_vk/error.h"
#include "asdf_vk/session.h"
#include "asdf_vk/version.h"
#include "bindings.h"
#include "core/atomic_file.h"
#include "describe/fields.h"
#include "interruptible.h"
#include "page/page.h"
#include "pipeline/prepared_scene.h"
#include "render/png.h"
#include "render/result_picture.h"
#include "trace/scene_data.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

/// Sets label and unit of a field whose name is that of a field of a result.
void describe(Field& field) {
  for (const FieldRow& row : fieldRows())
    if (row.name == field.name && static_cast<size_t>(row.type) == field.values.index()) {
      field.label = row.label;
      field.unit = row.unit;
    }
}

/// The fields of one component, segments first. Throws Error{OptionConflict} for no field or one of a wrong size.
std::vector<Field> shownFields(const py::dict& perFace, uint64_t faceCount) {
  std::vector<Field> fields = fieldsOf(perFace, {});
  std::erase_if(fields, [](const Field& field) { return field.componentCount != 1; });
  if (fields.empty())
    throw Error(ErrorCode::OptionConflict, "there is nothing to show; give a field per face of one component");
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

/// A result with the scene that pictures need.
Result shownResult(const MeshView& mesh, const RunControl& control) {
  StageSeconds seconds;
  StageClock clock(seconds);
  const auto prepared = std::make_shared<PreparedScene>(mesh, Orientation::Keep, clock, control);
  Result result;
  result.scene = std::make_shared<SceneData>(SceneData{prepared, prepared->view()});
  return result;
}

/// field: name of the field; empty: the first field.
void writePicture(const std::filesystem::path& path, const py::object& mesh, const py::dict& perFace,
                  const std::string& field) {
  requireSameProcess();
  const MeshView view = viewOf(mesh);
  const std::vector<Field> fields = shownFields(perFace, view.inputFaceCount());
  const Field& shown = field.empty() ? fields.front() : requireField(fields, field);
  runInterruptibly(
      [&](const RunControl& control) {
        const Result result = shownResult(view, control);
        writePng(path, pictureOf(result, shown, viewOf({}, "", result, false), {}, control));
      },
      py::none());
}

struct Layer {
  std::vector<Field> fields;
  PageTexts texts;
};

PageTexts textsOf(const py::dict& texts) {
  PageTexts read;
  read.name = texts["name"].cast<std::string>();
  read.label = texts["label"].cast<std::string>();
  read.summary = texts["summary"].cast<std::vector<std::pair<std::string, std::string>>>();
  read.errorSentence = texts["error_sentence"].cast<std::string>();
  read.warnings = texts["warnings"].cast<std::vector<std::string>>();
  read.defects = texts["defects"].cast<std::vector<std::string>>();
  return read;
}

std::vector<PageSegment> segmentsOf(const TraceScene& scene, const std::vector<Field>& fields) {
  const Field *const segment = findField(fields, "segment"), *const sdf = findField(fields, "sdf");
  const auto* const labels = segment == nullptr ? nullptr : std::get_if<std::vector<uint32_t>>(&segment->values);
  if (labels == nullptr) return {};
  const std::vector<double> none(labels->size(), kNoValue);
  return listSegments(scene.mesh, scene.geometry.areas, scene.geometry.barycentres, *labels,
                      sdf != nullptr && sdf->reals() != nullptr ? *sdf->reals() : none);
}

void addLayer(Page& page, const Result& result, Layer& layer, const RunControl& control) {
  const View view = viewOf({}, "", result, false);
  layer.texts.up = nameOf(kUps, view.up);
  layer.texts.azimuthDegrees = view.azimuthDegrees;
  layer.texts.elevationDegrees = view.elevationDegrees;
  layer.texts.segments = segmentsOf(result.scene->scene, layer.fields);
  layer.texts.picture = encodePng(pictureOf(result, layer.fields.front(), view, kPagePicture, control));
  const std::vector<std::reference_wrapper<const Field>> fields(layer.fields.begin(), layer.fields.end());
  page.add(result.scene->scene.mesh, fields, std::move(layer.texts));
}

void writePage(const std::filesystem::path& path, const py::object& mesh,
               const std::vector<std::pair<py::dict, py::dict>>& layers) {
  requireSameProcess();
  const MeshView view = viewOf(mesh);
  std::vector<Layer> read;
  for (const auto& [fields, texts] : layers)
    read.push_back({shownFields(fields, view.inputFaceCount()), textsOf(texts)});
  runInterruptibly(
      [&](const RunControl& control) {
        const Result result = shownResult(view, control);
        Page page(std::string("asdf-vk ") + ASDFVK_VERSION + " (" + ASDFVK_COMMIT + ")");
        for (Layer& layer : read) addLayer(page, result, layer, control);
        AtomicFile file(path);
        page.write(file);
        file.commit();
      },
      py::none());
}

}  // namespace

void bindShown(py::module_& module) {
  module.def("write_picture", writePicture);
  module.def("write_page", writePage);
}

}  // namespace asdfvk::python
