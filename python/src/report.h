#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/report.h"

namespace asdfvk::python {

/// Bytes that are not UTF-8, as in names of files, become surrogates, as by os.fsdecode().
[[nodiscard]] pybind11::str textOf(const std::string& text);

/// The report as a dictionary with the fields of asdf_vk.Report, nested ones as dictionaries. Unset ones are None.
[[nodiscard]] pybind11::dict dictOf(const Report& report);

/// Dictionaries with code, message and details.
[[nodiscard]] pybind11::list listOf(const std::vector<Warning>& warnings);

[[nodiscard]] pybind11::dict dictOf(const std::vector<ErrorDetail>& details);

}  // namespace asdfvk::python
