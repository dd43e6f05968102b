#include "gil.h"

#include <unistd.h>

namespace py = pybind11;

namespace asdfvk::python {
namespace {

/// If the stack is unwound by pthread_exit(), the destructor blocks the thread for ever. A catch clause cannot replace
/// this object: inside of another handler, it would end the process.
class UnwindingStop {
 public:
  UnwindingStop() = default;
  ~UnwindingStop() {
    while (!isPassed_) pause();
  }
  UnwindingStop(const UnwindingStop&) = delete;
  UnwindingStop& operator=(const UnwindingStop&) = delete;

  void pass() { isPassed_ = true; }

 private:
  bool isPassed_ = false;
};

}  // namespace

GilRelease::GilRelease() : state_(PyEval_SaveThread()) {}

GilRelease::~GilRelease() noexcept(false) {
  UnwindingStop stop;
  PyEval_RestoreThread(state_);
  stop.pass();
}

py::object callPython(const py::handle& callable, const py::tuple& arguments) {
  UnwindingStop stop;
  PyObject* result = PyObject_CallObject(callable.ptr(), arguments.ptr());
  stop.pass();
  if (result == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(result);
}

}  // namespace asdfvk::python
