#include "bindings.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "arrays.h"
#include "asdf_vk/scene.h"
#include "interruptible.h"
#include "options.h"
#include "report.h"
#include "session.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

/// Waits until no other thread uses the session, and returns compute(session, control).
template <typename Compute>
auto runOn(SharedSession& session, const py::object& progress, const Compute& compute) {
  std::invoke_result_t<const Compute&, Session&, const RunControl&> result;
  session.run([&](Session& idle, const RunControl& control) { result = compute(idle, control); }, progress);
  return result;
}

/// A scene, together with the session and the arrays to which the scene refers.
class SharedScene {
 public:
  SharedScene(std::shared_ptr<SharedSession> session, const py::object& mesh, const py::dict& options,
              const py::object& progress)
      : session_(std::move(session)), mesh_(mesh) {
    const Orientation orientation = optionsOf(options)->orientation;
    const MeshView view = viewOf(mesh_);
    session_->run(
        [&](Session& idle, const RunControl& control) {
          scene_ = std::make_unique<Scene>(idle, view, orientation, control);
        },
        progress);
  }
  /// SharedSession::release() describes the release, and ~SharedSession() describes forked processes.
  ~SharedScene() {
    if (isForkedProcess()) {
      (void)scene_.release();
    } else {
      session_->release(std::move(scene_));
    }
  }
  SharedScene(const SharedScene&) = delete;
  SharedScene& operator=(const SharedScene&) = delete;

  [[nodiscard]] Result compute(const py::dict& options, const py::object& region, const py::object& progress) {
    const CheckedOptions parsed = optionsOf(options);
    std::span<const uint8_t> mask;
    if (!region.is_none()) mask = entriesOf<uint8_t>(region.cast<py::array>());
    return runOn(*session_, progress,
                 [&](Session&, const RunControl& control) { return scene_->compute(parsed, mask, control); });
  }

  [[nodiscard]] Result compare(const SharedScene& former, const py::dict& options, const py::object& region,
                               const py::object& progress) {
    const CheckedOptions parsed = optionsOf(options, true);
    std::span<const uint8_t> mask;
    if (!region.is_none()) mask = entriesOf<uint8_t>(region.cast<py::array>());
    return runOn(*session_, progress, [&](Session&, const RunControl& control) {
      return scene_->compare(*former.scene_, parsed, mask, control);
    });
  }

  /// points, normals: #P x 3 double. Returns #P float.
  [[nodiscard]] py::array_t<float> valuesAt(const py::array& points, const py::array& normals, const py::dict& options,
                                            const py::object& progress) {
    const ConeOptions cone = optionsOf(options)->cone;
    const std::span<const double> origins = entriesOf<double>(points), axes = entriesOf<double>(normals);
    const std::vector<double> values = runOn(*session_, progress, [&](Session&, const RunControl& control) {
      return scene_->valuesAt(origins, axes, cone, control);
    });
    return singles(values, "at()");
  }

  /// points, normals: #P x 3 double. Returns #P double.
  [[nodiscard]] py::array_t<double> thicknessAt(const py::array& points, const py::array& normals,
                                                const py::dict& options, const py::object& progress) {
    const ThicknessOptions thickness = optionsOf(options)->thickness;
    const std::span<const double> places = entriesOf<double>(points), axes = entriesOf<double>(normals);
    return asArray(runOn(*session_, progress, [&](Session&, const RunControl& control) {
      return scene_->thicknessAt(places, axes, thickness, control);
    }));
  }

  /// points: #P x 3 double. Returns #P double: radii if givesRadii, otherwise distances.
  [[nodiscard]] py::array_t<double> distance(const py::array& points, bool givesRadii, const py::object& progress) {
    const std::span<const double> places = entriesOf<double>(points);
    return asArray(runOn(*session_, progress, [&](Session&, const RunControl& control) {
      return givesRadii ? scene_->radii(places, control) : scene_->distance(places, control);
    }));
  }

  /// origins, directions: #R x 3 double. Returns #R lengths (double), and #R input faces, -1 for no hit.
  [[nodiscard]] py::tuple firstHits(const py::array& origins, const py::array& directions, const py::object& progress) {
    const std::span<const double> starts = entriesOf<double>(origins), axes = entriesOf<double>(directions);
    Scene::RayHits hits = runOn(*session_, progress, [&](Session&, const RunControl& control) {
      return scene_->firstHits(starts, axes, control);
    });
    return py::make_tuple(asArray(std::move(hits.distances)),
                          asArray(std::vector<int32_t>(hits.faces.begin(), hits.faces.end())));
  }

  /// points: #P x 3 double. Returns #P input faces.
  [[nodiscard]] py::array_t<uint32_t> nearestFaces(const py::array& points, const py::object& progress) {
    const std::span<const double> places = entriesOf<double>(points);
    return asArray(runOn(*session_, progress,
                         [&](Session&, const RunControl& control) { return scene_->nearestFaces(places, control); }));
  }

 private:
  std::shared_ptr<SharedSession> session_;
  py::object mesh_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace

void bindScenes(py::module_& module) {
  // The array of a field is made when Python reads the field.
  py::class_<Result>(module, "ComputedFields")
      .def("names",
           [](const Result& self, bool perVertex) {
             std::vector<std::string> names;
             for (const Field& field : self.fields)
               if ((field.location == FieldLocation::PerVertex) == perVertex) names.push_back(field.name);
             return names;
           })
      .def(
          "array",
          [](const Result& self, const std::string& name, bool perVertex, bool single) {
            const Field* field =
                findField(self.fields, name, perVertex ? FieldLocation::PerVertex : FieldLocation::PerFace);
            if (field == nullptr) throw Error(ErrorCode::UnknownField, "the result has no field '" + name + "'");
            return arrayOf(*field, single);
          },
          py::arg("name"), py::arg("per_vertex") = false, py::arg("single") = true)
      .def("warnings", [](const Result& self) { return warningsOf(self.report); })
      .def("report", [](const Result& self) { return reportOf(self.report); })
      .def("reversed_faces", [](const Result& self) {
        const std::vector<uint64_t>& faces = self.reversedFaces;
        return asArray(std::vector<int64_t>(faces.begin(), faces.end()));
      });

  py::class_<SharedSession, std::shared_ptr<SharedSession>>(module, "Session")
      .def(py::init([](const py::dict& options) { return std::make_shared<SharedSession>(sessionOf(options)); }))
      .def_property_readonly("backend", [](const SharedSession& self) { return self.session().backend(); })
      .def_property_readonly("device_lines", [](const SharedSession& self) { return self.session().deviceLines(); })
      .def_property_readonly("runs_on_cpu", [](const SharedSession& self) { return self.session().runsOnCpu(); })
      .def("compute",
           [](SharedSession& self, const py::object& mesh, const py::dict& options, const py::object& progress) {
             const CheckedOptions parsed = optionsOf(options);
             const MeshView view = viewOf(mesh);
             return runOn(self, progress, [&](Session& session, const RunControl& control) {
               return session.compute(view, parsed, control);
             });
           });

  py::class_<SharedScene>(module, "Scene")
      .def(py::init<std::shared_ptr<SharedSession>, const py::object&, const py::dict&, const py::object&>())
      .def("compute", &SharedScene::compute)
      .def("compare", &SharedScene::compare)
      .def("values_at", &SharedScene::valuesAt)
      .def("thickness_at", &SharedScene::thicknessAt)
      .def("nearest_faces", &SharedScene::nearestFaces)
      .def("distance", &SharedScene::distance)
      .def("first_hits", &SharedScene::firstHits);
}

}  // namespace asdfvk::python
