#pragma once

#include <pybind11/pybind11.h>

namespace asdfvk::python {

/// ComputedFields, Session and Scene.
void bindScenes(pybind11::module_& module);

}  // namespace asdfvk::python
