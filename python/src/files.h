#pragma once

#include <pybind11/pybind11.h>

namespace asdfvk::python {

/// Mesh, readers and writers.
void bindFiles(pybind11::module_& module);

}  // namespace asdfvk::python
