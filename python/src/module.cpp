// asdf_vk._core: the public library for the Python package, which validates arrays and names.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>

#include "arrays.h"
#include "asdf_vk/asdf_vk.h"
#include "cgal.h"
#include "files.h"
#include "interruptible.h"
#include "options.h"
#include "report.h"
#include "session.h"

namespace py = pybind11;
using namespace pybind11::literals;

namespace asdfvk::python {
namespace {

/// Raises the class of asdf_vk._errors for the kind of the error.
void raise(const Error& error) {
  const py::object make = py::module_::import("asdf_vk._errors").attr("error_of");
  const py::object exception = make(nameOf(error.code()), error.what(), dictOf(error.details()));
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const Error& error) {
    raise(error);
  }
}

const char* nameOfKind(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Usage:
      return "usage";
    case ErrorKind::Input:
      return "input";
    case ErrorKind::Device:
      return "device";
    case ErrorKind::Output:
      return "output";
    case ErrorKind::Cancelled:
      return "cancelled";
  }
  return "";
}

/// The kind of each error code, by names.
py::dict errorKinds() {
  py::dict kinds;
  for (int i = 0; i <= static_cast<int>(ErrorCode::Cancelled); ++i) {
    const auto code = static_cast<ErrorCode>(i);
    kinds[nameOf(code)] = nameOfKind(kindOf(code));
  }
  return kinds;
}

template <typename Compute>
std::unique_ptr<ComputedFields> computed(SharedSession& session, const py::object& progress, const Compute& compute) {
  std::optional<Result> result;
  session.run([&](Session& idle, const RunControl& control) { result = compute(idle, control); }, progress);
  return std::make_unique<ComputedFields>(std::move(*result));
}

py::list devices() {
  requireSameProcess();
  py::list list;
  std::string reason;
  const std::vector<DeviceInfo> infos = [&] {
    const py::gil_scoped_release released;
    return listDevices(&reason);
  }();
  for (const DeviceInfo& device : infos)
    list.append(py::dict("name"_a = device.name, "driver"_a = device.driver, "kind"_a = device.kind,
                         "usable"_a = device.usable, "reason"_a = device.reason));
  return list;
}

void bindSession(py::module_& module) {
  py::class_<ComputedFields>(module, "ComputedFields")
      .def("names",
           [](const ComputedFields& self, bool perVertex) {
             std::vector<std::string> names;
             for (const Field& field : self.fields())
               if ((field.location == FieldLocation::PerVertex) == perVertex) names.push_back(field.name);
             return names;
           })
      .def("array",
           [](const py::object& self, const std::string& name, bool perVertex, bool single) {
             const auto& fields = self.cast<const ComputedFields&>();
             const Field* field =
                 findField(fields.fields(), name, perVertex ? FieldLocation::PerVertex : FieldLocation::PerFace);
             if (field == nullptr) throw Error(ErrorCode::UnknownField, "the result has no field '" + name + "'");
             return arrayOf(*field, single, self);
           })
      .def("warnings", [](const ComputedFields& self) { return listOf(self.report().warnings); })
      .def("report", [](const ComputedFields& self) { return dictOf(self.report()); });

  py::class_<SharedSession>(module, "Session")
      .def(py::init([](const std::string& backend, const std::string& device, bool requireGpu, uint32_t threadCount) {
        return std::make_unique<SharedSession>(
            SessionOptions{.backend = backend, .device = device, .requireGpu = requireGpu, .variant = {}}, threadCount);
      }))
      .def_property_readonly("backend", [](const SharedSession& self) { return self.session().backend(); })
      .def_property_readonly("device_lines", [](const SharedSession& self) { return self.session().deviceLines(); })
      .def_property_readonly("runs_on_cpu", [](const SharedSession& self) { return self.session().runsOnCpu(); })
      .def("compute",
           [](SharedSession& self, const py::object& mesh, const py::dict& options, const py::object& progress) {
             const Options parsed = optionsOf(options);
             const MeshView view = viewOf(mesh);
             return computed(self, progress, [&](Session& session, const RunControl& control) {
               return session.compute(view, parsed, control);
             });
           });
}

}  // namespace
}  // namespace asdfvk::python

PYBIND11_MODULE(_core, module) {
  using namespace asdfvk;
  using namespace asdfvk::python;
  module.attr("version") = ASDFVK_VERSION;
  module.attr("commit") = ASDFVK_COMMIT;
  module.attr("error_kinds") = errorKinds();
  py::register_local_exception_translator(translate);
  module.def("option_names", optionNames);
  module.def("backend_names", backendNames);
  module.def("is_backend_built", isBackendBuilt);
  module.def("sampler_names", samplerNames);
  module.def("solver_names", solverNames);
  module.def("result_formats", resultFormats);
  module.def("mesh_formats", meshFormats);
  module.def("devices", devices);
  bindFiles(module);
  bindSession(module);
  bindCgal(module);
}
