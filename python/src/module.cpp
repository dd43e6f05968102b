// The extension asdf_vk._core, with which the Python package calls the library. The package validates arrays and names.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "asdf_vk/asdf_vk.h"
#include "bindings.h"
#include "core/error_kind.h"
#include "gil.h"
#include "interruptible.h"
#include "options.h"
#include "report.h"

namespace py = pybind11;
using namespace pybind11::literals;

namespace asdfvk::python {
namespace {

/// Raises an exception of asdf_vk._errors. The kind of the error selects the class.
void raise(const Error& error) {
  const py::object make = py::module_::import("asdf_vk._errors").attr("error_of");
  const py::object exception =
      callPython(make, py::make_tuple(nameOf(error.code()), textOf(error.what()), dictOf(error.details())));
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const Error& error) {
    raise(error);
  }
}

/// A dictionary from names of error codes to names of error kinds.
py::dict errorKinds() {
  py::dict kinds;
  for (int i = 0; i <= static_cast<int>(ErrorCode::Cancelled); ++i) {
    const auto code = static_cast<ErrorCode>(i);
    kinds[nameOf(code)] = rowOf(kindOf(code)).name;
  }
  return kinds;
}

py::list devices() {
  requireSameProcess();
  py::list list;
  std::string reason;
  std::vector<DeviceInfo> infos;
  runInterruptibly([&](const RunControl&) { infos = listDevices(&reason); }, py::none());
  for (const DeviceInfo& device : infos)
    list.append(py::dict("name"_a = device.name, "driver"_a = device.driver, "kind"_a = device.kind,
                         "usable"_a = device.usable, "reason"_a = device.reason));
  return list;
}

}  // namespace
}  // namespace asdfvk::python

// The macro defines asdfvkInitialiseCore(), which PyInit__core() below calls.
#define PyInit__core asdfvkInitialiseCore
PYBIND11_MODULE(_core, module) {
  using namespace asdfvk;
  using namespace asdfvk::python;
  module.attr("version") = ASDFVK_VERSION;
  module.attr("commit") = ASDFVK_COMMIT;
  module.attr("error_kinds") = errorKinds();
  py::register_local_exception_translator(translate);
  module.def("option_names", optionNames);
  module.def("similar_keywords", similarKeywords);
  module.def("removed_keyword_text", removedKeywordText);
  module.def("session_key", [](const py::dict& values) {
    const SessionSettings session = sessionOf(values);
    return py::make_tuple(static_cast<int>(session.backend), session.device, session.requireGpu, session.threadCount);
  });
  module.def("devices", devices);
  bindFiles(module);
  bindScenes(module);
  bindShown(module);
  bindCgal(module);
  Py_AtExit(stopAtExit);
}
#undef PyInit__core

extern "C" PYBIND11_EXPORT PyObject* PyInit__core() {
  // Without this check, pybind11 2 would wait forever for the GIL if a sub-interpreter imports the module first.
  if (PyInterpreterState_Get() == PyInterpreterState_Main()) return asdfvkInitialiseCore();
  PyErr_SetString(PyExc_ImportError,
                  "asdf_vk can be imported only by the main interpreter of a process, not by sub-interpreters");
  return nullptr;
}
