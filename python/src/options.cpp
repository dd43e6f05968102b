#include "options.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "arrays.h"
#include "asdf_vk/error.h"
#include "describe/option_rules.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

constexpr OptionSpelling kSpelling = OptionSpelling::SnakeCase;

/// An integer of Python or NumPy as an option value. An integer that does not fit into uint64 becomes a real number.
OptionValue wholeOf(const py::handle& object) {
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
  if (index) {
    const unsigned long long whole = PyLong_AsUnsignedLongLong(index.ptr());
    if (PyErr_Occurred() == nullptr) return uint64_t{whole};
    PyErr_Clear();
    const double real = PyLong_AsDouble(index.ptr());
    if (PyErr_Occurred() == nullptr) return real;
  }
  PyErr_Clear();
  return {};
}

OptionValue textOf(const py::handle& object) {
  Py_ssize_t size = 0;
  if (const char* text = PyUnicode_AsUTF8AndSize(object.ptr(), &size))
    return std::string(text, static_cast<size_t>(size));
  PyErr_Clear();  // A text with an unpaired surrogate cannot be encoded in UTF-8.
  return {};
}

/// The option value of an object; std::monostate for an object of an unsupported type.
OptionValue valueOf(const py::handle& object) {
  if (isFlag(object)) return PyObject_IsTrue(object.ptr()) == 1;
  if (PyUnicode_Check(object.ptr())) return textOf(object);
  if (py::isinstance<py::tuple>(object) && py::len(object) == 2) {  // A pair: the rings and passes of `smooth`.
    const auto pair = py::reinterpret_borrow<py::tuple>(object);
    const OptionValue first = valueOf(pair[0]), second = valueOf(pair[1]);
    if (!std::holds_alternative<uint64_t>(first) || !std::holds_alternative<uint64_t>(second)) return {};
    return std::to_string(std::get<uint64_t>(first)) + "x" + std::to_string(std::get<uint64_t>(second));
  }
  if (PyIndex_Check(object.ptr()) != 0)
    if (OptionValue whole = wholeOf(object); !std::holds_alternative<std::monostate>(whole)) return whole;
  const double real = PyFloat_AsDouble(object.ptr());
  if (PyErr_Occurred() == nullptr) return real;
  PyErr_Clear();
  return {};
}

/// Sets the options in the order of the rows. The package has checked their names.
GivenOptions setOptions(const OptionRows& rows, const py::dict& values) {
  GivenOptions given{.names = {}, .spelling = kSpelling};
  for (const OptionRow& row : rows) {
    const std::string name = spelled(row, kSpelling);
    if (name.empty() || !values.contains(name)) continue;
    const py::object object = values[name.c_str()];
    if (object.is_none()) continue;
    setOption(row, valueOf(object), py::repr(object), kSpelling);
    given.names.insert(row.name);
  }
  return given;
}

}  // namespace

std::vector<std::string> optionNames() {
  ComputationSettings defaults;
  std::vector<std::string> names;
  for (const OptionRow& row : computationRows(defaults))
    if (std::string name = spelled(row, kSpelling); !name.empty()) names.push_back(std::move(name));
  return names;
}

std::string removedKeywordText(std::string_view name) { return removedOptionText(name, kSpelling); }

std::string similarKeywords(std::string_view name, const std::vector<std::string>& keywords) {
  std::string flag(name);
  std::replace(flag.begin(), flag.end(), '_', '-');
  ComputationSettings defaults;
  const OptionRows rows = computationRows(defaults);
  const OptionRow* const row = findOption(rows, flag);
  const std::string keyword = row == nullptr ? "" : spelled(*row, kSpelling);
  const bool isAllowed = std::find(keywords.begin(), keywords.end(), keyword) != keywords.end();
  return isAllowed ? keyword : similarNames(name, keywords);
}

CheckedOptions optionsOf(const py::dict& values, bool compares) {
  ComputationSettings computation;
  computation.compares = compares;
  complete(computation, setOptions(computationRows(computation), values));
  return computation.checked();
}

SessionSettings sessionOf(const py::dict& values) {
  SessionSettings session;
  (void)setOptions(sessionRows(session), values);
  requireValid(session, kSpelling);
  return session;
}

}  // namespace asdfvk::python
