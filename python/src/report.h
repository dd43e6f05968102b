#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/report.h"

namespace asdfvk::python {

/// The text as a str. Bytes that are not UTF-8 become surrogates, as in os.fsdecode(). Names of files can have such
/// bytes.
[[nodiscard]] pybind11::str textOf(const std::string& text);

[[nodiscard]] pybind11::dict dictOf(const std::vector<ErrorDetail>& details);

/// The report as asdf_vk._report.Report.
[[nodiscard]] pybind11::object reportOf(const Report& report);

/// A tuple of asdf_vk._report.Warning.
[[nodiscard]] pybind11::object warningsOf(const Report& report);

}  // namespace asdfvk::python
