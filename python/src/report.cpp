#include "report.h"

#include <pybind11/stl.h>

#include <cctype>
#include <optional>
#include <string>
#include <type_traits>

#include "describe/report_keys.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

std::string snakeCase(const std::string& key) {
  std::string text;
  for (const unsigned char c : key) {
    if (std::isupper(c) != 0) text += '_';
    text += static_cast<char>(std::tolower(c));
  }
  return text;
}

py::object objectOf(const std::string& text) { return python::textOf(text); }
py::object objectOf(const Vec3d& point) { return py::make_tuple(point.x, point.y, point.z); }
py::object objectOf(const std::vector<ErrorDetail>& details) { return dictOf(details); }

py::object objectOf(const StageSeconds& seconds) {
  py::dict stages;
  for (size_t i = 0; i < kStageCount; ++i) stages[nameOf(static_cast<Stage>(i))] = seconds.seconds[i];
  return stages;
}

template <typename T>
py::object objectOf(const T& value);

template <typename T>
py::object objectOf(const std::optional<T>& value) {
  return value ? objectOf(*value) : py::none();
}

template <typename T>
py::object objectOf(const std::vector<T>& items) {
  py::tuple tuple(items.size());
  for (size_t i = 0; i < items.size(); ++i) tuple[i] = objectOf(items[i]);
  return tuple;
}

/// The Python object of a value of the report: a number, a flag, a name, or the dataclass of a structure.
template <typename T>
py::object objectOf(const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    return py::cast(value);
  } else if constexpr (std::is_enum_v<T>) {
    return py::str(nameOf(choicesOf(value), value));
  } else {
    py::dict members;
    visitKeys(value,
              [&](const std::string& key, const auto& member) { members[snakeCase(key).c_str()] = objectOf(member); });
    return py::module_::import("asdf_vk._report").attr(structureName(value))(**members);
  }
}

}  // namespace

py::str textOf(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape"));
}

py::dict dictOf(const std::vector<ErrorDetail>& details) {
  py::dict dict;
  for (const ErrorDetail& detail : details) dict[textOf(detail.name)] = textOf(detail.value);
  return dict;
}

py::object reportOf(const Report& report) { return objectOf(report); }
py::object warningsOf(const Report& report) { return objectOf(report.warnings); }

}  // namespace asdfvk::python
