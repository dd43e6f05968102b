#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "asdf_vk/options.h"

namespace asdfvk::python {

/// Options by their names in Python. Throws Error{UnknownName} for an unknown key or choice, Error{OptionOutOfRange}
/// for a value of the wrong type or outside of its range.
[[nodiscard]] Options optionsOf(const pybind11::dict& values);

/// The keys of optionsOf().
[[nodiscard]] std::vector<std::string> optionNames();

}  // namespace asdfvk::python
