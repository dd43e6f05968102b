#pragma once

#include <pybind11/pybind11.h>

/// Before Python 3.14, a finalising interpreter calls pthread_exit() in daemon threads that take the GIL.
/// pthread_exit() unwinds the stack of the thread. During the unwinding, functions that are noexcept or catch all
/// exceptions end the process, and destructors release Python objects without the GIL. The functions below prevent the
/// unwinding: such a thread waits for the end of the process, as in Python 3.14.
namespace asdfvk::python {

/// Releases the GIL for its lifetime, like pybind11's gil_scoped_release.
class GilRelease {
 public:
  GilRelease();
  /// Throws nothing. But the function must not be noexcept, because then the compiler could omit the destructor that
  /// blocks the unwinding.
  ~GilRelease() noexcept(false);
  GilRelease(const GilRelease&) = delete;
  GilRelease& operator=(const GilRelease&) = delete;

 private:
  PyThreadState* state_;
};

/// Calls callable(*arguments), a Python function, which may release the GIL at any time. Throws error_already_set.
[[nodiscard]] pybind11::object callPython(const pybind11::handle& callable, const pybind11::tuple& arguments);

}  // namespace asdfvk::python
